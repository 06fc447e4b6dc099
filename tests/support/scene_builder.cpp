#include "tests/support/scene_builder.h"

#include <algorithm>
#include <cmath>

namespace radiosity::test {

std::int32_t Builder::add_surface(const std::string& name, bool two_sided) {
  Scene& scene = result.scene;
  scene.surfaces.push_back({name + std::to_string(scene.surfaces.size()), 0, two_sided});
  return static_cast<std::int32_t>(scene.surfaces.size()) - 1;
}

void Builder::add_polygon(std::int32_t surface, const Points& points, Piece piece) {
  std::vector<std::int32_t> indices;
  for (const Vec3& p : points) {
    indices.push_back(static_cast<std::int32_t>(result.scene.vertices.size()));
    result.scene.vertices.push_back(p);
  }
  result.scene.add_polygon(indices, surface);
  result.pieces.push_back(piece);
}

void Builder::add_piece(const std::string& name, const std::vector<Points>& polygons, Piece piece,
                        Division division) {
  std::int32_t surface = -1;
  for (const Points& polygon : polygons) {
    if (surface < 0 || division == Division::surface_per_face) surface = add_surface(name);
    add_polygon(surface, polygon, piece);
  }
}

std::vector<Points> box_faces(const Vec3& low, const Vec3& high) {
  std::vector<Points> faces;
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    for (const bool is_high : {false, true}) {
      Points face(4);
      for (int k = 0; k < 4; ++k) {
        face[k][axis] = is_high ? high[axis] : low[axis];
        face[k][u] = k == 1 || k == 2 ? high[u] : low[u];
        face[k][v] = k >= 2 ? high[v] : low[v];
      }
      if (!is_high) std::reverse(face.begin(), face.end());
      faces.push_back(face);
    }
  }
  return faces;
}

void turn_over(std::vector<Points>& polygons) {
  for (Points& polygon : polygons) std::reverse(polygon.begin(), polygon.end());
}

void Builder::add_box(const std::string& name, const Vec3& low, const Vec3& high, Division division,
                      Piece piece) {
  std::vector<Points> faces = box_faces(low, high);
  if (piece == Piece::hollow) turn_over(faces);
  add_piece(name, faces, piece, division);
}

Division any_division(Random& random) {
  return random.coin() ? Division::one_surface : Division::surface_per_face;
}

Points rectangle(double x0, double x1, double y0, double y1, double z) {
  return {{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}};
}

Points reversed(Points points) {
  std::reverse(points.begin(), points.end());
  return points;
}

void add_room(Builder& builder, Random& random, Vec3& low, Vec3& high) {
  low = {-random.uniform(0.7, 1), -random.uniform(0.7, 1), -random.uniform(0.5, 1)};
  high = {random.uniform(0.7, 1), random.uniform(0.7, 1), random.uniform(0.5, 1)};
  builder.add_box("room", low, high, any_division(random), Piece::hollow);
  builder.result.is_closed = true;
}

Points regular_polygon(int n, double radius, const Vec3& center, double phase) {
  Points points;
  for (int k = 0; k < n; ++k) {
    const double angle = phase + 2 * kPi * k / n;
    points.push_back(center + radius * Vec3(std::cos(angle), std::sin(angle), 0));
  }
  return points;
}

std::vector<Points> prism_faces(const Points& bottom, const Vec3& up) {
  Points top = bottom;
  for (Vec3& p : top) p += up;
  std::vector<Points> faces{reversed(bottom), top};
  for (std::size_t k = 0; k < bottom.size(); ++k) {
    const std::size_t next = (k + 1) % bottom.size();
    faces.push_back({bottom[k], bottom[next], top[next], top[k]});
  }
  return faces;
}

void add_plate(Builder& builder, Random& random, int kind, double x0, double x1, double y0,
               double y1, double z) {
  const Points points = rectangle(x0, x1, y0, y1, z);
  switch (kind) {
    case 0:
    case 1:
      builder.add_polygon(builder.add_surface("plate"), kind == 0 ? points : reversed(points));
      builder.result.is_closed = false;
      break;
    case 2:
      builder.add_polygon(builder.add_surface("sheet", true), points);
      break;
    default:
      builder.add_box("slab", {x0, y0, z}, {x1, y1, z + random.log_uniform(1e-3, 2e-2)},
                      any_division(random));
  }
}

}  // namespace radiosity::test

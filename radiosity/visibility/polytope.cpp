#include "radiosity/visibility/polytope.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace radiosity {
namespace {

/// Bodies thinner than this share of their size are flat.
constexpr double kFlat = 1e-4;
constexpr int kPolygonSides = 12;
/// Edges shorter than this share of the size have no direction to speak of and are left out.
constexpr double kShort = 1e-7;
/// Bodies within are made smaller by this share, so that nothing is hidden by what is left out.
constexpr double kMargin = 1e-6;

/// A face under construction: corners, each with the number of the plane that cut the edge after
/// it.
struct Corner {
  Vec3 point;
  int edge;
};

std::vector<Corner> clip(const std::vector<Corner>& face, const HalfSpace& plane, int number) {
  std::vector<Corner> result;
  for (std::size_t k = 0; k < face.size(); ++k) {
    const Corner& a = face[k];
    const Corner& b = face[(k + 1) % face.size()];
    const double height_a = plane.normal.dot(a.point) - plane.offset;
    const double height_b = plane.normal.dot(b.point) - plane.offset;
    if (height_a <= 0) result.push_back(a);
    if ((height_a <= 0) == (height_b <= 0)) continue;
    const Vec3 point = a.point + height_a / (height_a - height_b) * (b.point - a.point);
    result.push_back({point, height_a <= 0 ? number : a.edge});
  }
  return result;
}

void set_bounds(Blocker& body) {
  body.box.setEmpty();
  for (const Vec3& corner : body.corners) body.box.extend(corner);
  set_sphere(body);
}

}  // namespace

std::optional<Blocker> make_polytope(std::vector<HalfSpace> faces) {
  Blocker body;
  body.faces = std::move(faces);
  double reach = 0;
  for (const HalfSpace& face : body.faces) reach = std::max(reach, std::abs(face.offset));
  std::map<std::pair<int, int>, bool> had;
  const int n = static_cast<int>(body.faces.size());
  for (int f = 0; f < n; ++f) {
    const HalfSpace& plane = body.faces[f];
    const Vec3 u = plane.normal.unitOrthogonal();
    const Vec3 v = plane.normal.cross(u);
    const Vec3 middle = plane.offset * plane.normal;
    const double far = 1e3 * reach;
    std::vector<Corner> polygon;
    for (const auto& [s, t] : {std::pair(-far, -far), {far, -far}, {far, far}, {-far, far}}) {
      polygon.push_back({middle + s * u + t * v, -1});
    }
    for (int g = 0; g < n && !polygon.empty(); ++g) {
      if (g != f) polygon = clip(polygon, body.faces[g], g);
    }
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Corner& corner = polygon[k];
      if (corner.edge < 0) return std::nullopt;  // not bounded
      body.corners.push_back(corner.point);
      if (!had.try_emplace(std::minmax(f, corner.edge), true).second) continue;
      const Vec3& end = polygon[(k + 1) % polygon.size()].point;
      if ((end - corner.point).norm() <= kShort * reach) continue;
      body.edges.push_back({corner.point, end, f, corner.edge});
    }
  }
  if (body.edges.size() < 6) return std::nullopt;
  set_bounds(body);
  return body;
}

std::optional<Blocker> enclosing_polytope(std::span<const Vec3> points) {
  Box3 box;
  for (const Vec3& point : points) box.extend(point);
  if (box.isEmpty()) return std::nullopt;
  const Vec3 center = box.center();
  std::vector<HalfSpace> faces;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        const Vec3 normal = Vec3(x, y, z).normalized();
        double offset = -1e300;
        double least = 1e300;
        for (const Vec3& point : points) {
          offset = std::max(offset, normal.dot(point - center));
          least = std::min(least, normal.dot(point - center));
        }
        if (offset - least <= kFlat * box.diagonal().norm()) return std::nullopt;
        faces.push_back({normal, offset});
      }
    }
  }
  std::optional<Blocker> body = make_polytope(std::move(faces));
  if (!body) return std::nullopt;
  for (HalfSpace& face : body->faces) face.offset += face.normal.dot(center);
  for (Blocker::Edge& edge : body->edges) {
    edge.start += center;
    edge.end += center;
  }
  for (Vec3& corner : body->corners) corner += center;
  set_bounds(*body);
  return body;
}

std::optional<Blocker> enclosing_polygon(std::span<const Vec3> points, const HalfSpace& plane) {
  const Vec3 u = plane.normal.unitOrthogonal();
  const Vec3 v = plane.normal.cross(u);
  const Vec3 origin = points.front();
  std::array<Vec3, kPolygonSides> normals;
  std::array<double, kPolygonSides> offsets;
  for (int k = 0; k < kPolygonSides; ++k) {
    const double angle = 2 * kPi * k / kPolygonSides;
    normals[k] = std::cos(angle) * u + std::sin(angle) * v;
    offsets[k] = -1e300;
    for (const Vec3& point : points) {
      offsets[k] = std::max(offsets[k], normals[k].dot(point - origin));
    }
  }
  double size = 0;
  for (int k = 0; k < kPolygonSides; ++k) {
    size = std::max(size, offsets[k] + offsets[(k + kPolygonSides / 2) % kPolygonSides]);
  }
  // A generous square, cut down side by side.
  std::vector<Corner> polygon;
  for (int k = 0; k < 4; ++k) {
    const double angle = kPi / 2 * k;
    polygon.push_back({origin + 4 * size * (std::cos(angle) * u + std::sin(angle) * v), 0});
  }
  for (int k = 0; k < kPolygonSides; ++k) {
    polygon = clip(polygon, {normals[k], offsets[k] + normals[k].dot(origin)}, k);
  }
  if (polygon.size() < 3) return std::nullopt;
  Blocker body;
  body.faces = {plane, {-plane.normal, -plane.offset}};
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3& end = polygon[(k + 1) % polygon.size()].point;
    body.corners.push_back(polygon[k].point);
    if ((end - polygon[k].point).norm() <= kShort * size) continue;
    body.edges.push_back({polygon[k].point, end, 0, 1});
  }
  set_bounds(body);
  return body;
}

Blocker shrunk(const Blocker& body, const Vec3& about, double most) {
  const double factor = most * (1 - kMargin);
  const auto moved = [&](const Vec3& point) { return Vec3(about + factor * (point - about)); };
  Blocker result;
  for (const HalfSpace& face : body.faces) {
    const double center = face.normal.dot(about);
    result.faces.push_back({face.normal, center + factor * (face.offset - center)});
  }
  for (const Blocker::Edge& edge : body.edges) {
    result.edges.push_back({moved(edge.start), moved(edge.end), edge.left, edge.right});
  }
  for (const Vec3& corner : body.corners) result.corners.push_back(moved(corner));
  set_bounds(result);
  return result;
}

}  // namespace radiosity

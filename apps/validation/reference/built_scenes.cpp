#include "apps/validation/reference/built_scenes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace apps::validation {

using namespace radiosity;

namespace {

Emission grey_emission(const Grey& grey) {
  if (grey.temperature > 0) {
    return {Emission::Kind::temperature, Eigen::VectorXd::Constant(1, grey.temperature)};
  }
  if (grey.exitance > 0) {
    return {Emission::Kind::exitance, Eigen::VectorXd::Constant(1, grey.exitance)};
  }
  return {};
}

/// The 12 corners of an icosahedron in the unit sphere.
std::array<Vec3, 12> icosahedron_corners() {
  const double golden = (1 + std::sqrt(5.)) / 2;
  std::array<Vec3, 12> corners;
  std::size_t n = 0;
  for (const double a : {-1., 1.}) {
    for (const double b : {-golden, golden}) {
      corners[n++] = Vec3(0, a, b).normalized();
      corners[n++] = Vec3(a, b, 0).normalized();
      corners[n++] = Vec3(b, 0, a).normalized();
    }
  }
  return corners;
}

/// The 20 faces: corners that are one edge apart, facing outwards.
std::vector<Polygon> icosahedron() {
  const auto corners = icosahedron_corners();
  const double edge = 4 / std::sqrt(10 + 2 * std::sqrt(5.));
  const auto is_edge = [&](std::size_t i, std::size_t j) {
    return (corners[i] - corners[j]).norm() < 1.1 * edge;
  };
  std::vector<Polygon> faces;
  for (std::size_t i = 0; i < 12; ++i) {
    for (std::size_t j = i + 1; j < 12; ++j) {
      for (std::size_t k = j + 1; k < 12; ++k) {
        if (!is_edge(i, j) || !is_edge(j, k) || !is_edge(i, k)) continue;
        Polygon face{corners[i], corners[j], corners[k]};
        if (vector_area(face).dot(face[0]) < 0) std::swap(face[1], face[2]);
        faces.push_back(face);
      }
    }
  }
  return faces;
}

}  // namespace

Scene empty_scene(const std::string& name) {
  Scene scene;
  scene.source = name;
  scene.bands.kind = Bands::Kind::grey;
  return scene;
}

std::int32_t add_surface(Scene& scene, const std::string& name,
                         const std::vector<Polygon>& polygons, const Grey& grey) {
  const auto surface = static_cast<std::int32_t>(scene.surfaces.size());
  const auto material = static_cast<int>(scene.materials.size());
  scene.materials.push_back(
      {name, Eigen::VectorXd::Constant(1, grey.reflectance), grey_emission(grey)});
  scene.surfaces.push_back({name, material, grey.two_sided});
  for (const Polygon& polygon : polygons) {
    std::vector<std::int32_t> corners(polygon.size());
    std::iota(corners.begin(), corners.end(), static_cast<std::int32_t>(scene.vertices.size()));
    scene.vertices.insert(scene.vertices.end(), polygon.begin(), polygon.end());
    scene.add_polygon(corners, surface);
  }
  return surface;
}

Polygon parallelogram(const Vec3& a, const Vec3& u, const Vec3& v) {
  return {a, a + u, a + u + v, a + v};
}

std::vector<Polygon> box_faces(const Vec3& low, const Vec3& high, Facing facing) {
  const Vec3 x(high.x() - low.x(), 0, 0);
  const Vec3 y(0, high.y() - low.y(), 0);
  const Vec3 z(0, 0, high.z() - low.z());
  std::vector<Polygon> faces = {parallelogram(low, x, y), parallelogram(low + z, y, x),
                                parallelogram(low, y, z), parallelogram(low + x, z, y),
                                parallelogram(low, z, x), parallelogram(low + y, x, z)};
  if (facing == Facing::outwards) {
    for (Polygon& face : faces) std::swap(face[1], face[3]);
  }
  return faces;
}

Polygon regular_polygon(int n, double radius, double z, bool faces_up) {
  Polygon polygon;
  for (int k = 0; k < n; ++k) {
    const double angle = 2 * kPi * (faces_up ? k : -k) / n;
    polygon.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
  }
  return polygon;
}

std::vector<Polygon> prism_inside(const Polygon& base, double height) {
  const Vec3 up(0, 0, height);
  std::vector<Polygon> faces = {base, {}};
  for (auto corner = base.rbegin(); corner != base.rend(); ++corner) {
    faces[1].push_back(*corner + up);
  }
  for (std::size_t k = 0; k < base.size(); ++k) {
    const Vec3& a = base[k];
    const Vec3& b = base[(k + 1) % base.size()];
    faces.push_back({b, a, a + up, b + up});
  }
  return faces;
}

std::vector<Polygon> icosphere(int level, double radius, Facing facing) {
  std::vector<Polygon> faces = icosahedron();
  for (int k = 0; k < level; ++k) {
    std::vector<Polygon> finer;
    finer.reserve(4 * faces.size());
    for (const Polygon& f : faces) {
      const Vec3 ab = (f[0] + f[1]).normalized();
      const Vec3 bc = (f[1] + f[2]).normalized();
      const Vec3 ca = (f[2] + f[0]).normalized();
      finer.insert(finer.end(), {{f[0], ab, ca}, {ab, f[1], bc}, {ca, bc, f[2]}, {ab, bc, ca}});
    }
    faces = std::move(finer);
  }
  for (Polygon& face : faces) {
    for (Vec3& corner : face) corner *= radius;
    if (facing == Facing::inwards) std::swap(face[1], face[2]);
  }
  return faces;
}

}  // namespace apps::validation

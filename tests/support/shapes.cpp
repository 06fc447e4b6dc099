#include "tests/support/shapes.h"

#include <algorithm>
#include <array>
#include <string>

namespace radiosity::test {

std::int32_t add_grid(PatchMesh& mesh, const Vec3& a, const Vec3& u, const Vec3& v, int nu,
                      int nv) {
  const auto surface = static_cast<std::int32_t>(mesh.surface_names.size());
  mesh.surface_names.push_back("surface " + std::to_string(surface));
  mesh.surface_two_sided.push_back(false);
  const auto first = static_cast<std::int32_t>(mesh.vertices.size());
  for (int j = 0; j <= nv; ++j) {
    for (int i = 0; i <= nu; ++i) mesh.vertices.push_back(a + u * i / nu + v * j / nv);
  }
  for (int j = 0; j < nv; ++j) {
    for (int i = 0; i < nu; ++i) {
      const std::int32_t corner = first + j * (nu + 1) + i;
      mesh.add_patch({corner, corner + 1, corner + nu + 2, corner + nu + 1}, surface, surface);
    }
  }
  return surface;
}

void add_box(PatchMesh& mesh, const Vec3& low, const Vec3& high, int n, Facing facing) {
  const Vec3 x(high.x() - low.x(), 0, 0);
  const Vec3 y(0, high.y() - low.y(), 0);
  const Vec3 z(0, 0, high.z() - low.z());
  const auto add = [&](const Vec3& a, const Vec3& u, const Vec3& v) {
    if (facing == Facing::inwards) {
      add_grid(mesh, a, u, v, n, n);
    } else {
      add_grid(mesh, a, v, u, n, n);
    }
  };
  add(low, x, y);
  add(low + z, y, x);
  add(low, y, z);
  add(low + x, z, y);
  add(low, z, x);
  add(low + y, x, z);
}

PatchMesh box_in_box(int n_walls, int n_box) {
  PatchMesh mesh;
  add_box(mesh, Vec3::Zero(), Vec3::Ones(), n_walls, Facing::inwards);
  add_box(mesh, {.35, .3, .25}, {.65, .6, .75}, n_box, Facing::outwards);
  return mesh;
}

Vec3 random_unit(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  return Vec3(normal(random), normal(random), normal(random)).normalized();
}

Vec3 random_point(std::span<const Vec3> corners, std::mt19937_64& random) {
  std::exponential_distribution<double> weight;
  Vec3 sum = Vec3::Zero();
  double total = 0;
  for (const Vec3& corner : corners) {
    const double w = weight(random);
    sum += w * corner;
    total += w;
  }
  return sum / total;
}

double length_inside(std::span<const HalfSpace> faces, const Vec3& from, const Vec3& to) {
  double first = 0;
  double last = 1;
  for (const HalfSpace& face : faces) {
    const double a = face.normal.dot(from) - face.offset;
    const double b = face.normal.dot(to) - face.offset;
    if (a >= 0 && b >= 0) return 0;
    if (a > 0) first = std::max(first, a / (a - b));
    if (b > 0) last = std::min(last, a / (a - b));
  }
  return std::max(0.0, last - first);
}

void make_two_sided(PatchMesh& mesh, std::int32_t surface) {
  const Index n = mesh.size();
  mesh.surface_two_sided[surface] = true;
  for (Index i = 0; i < n; ++i) {
    if (mesh.surface[i] != surface) continue;
    const auto c = mesh.corners[i];
    const auto back =
        c[3] < 0 ? std::array{c[2], c[1], c[0], -1} : std::array{c[3], c[2], c[1], c[0]};
    mesh.twin[i] = static_cast<std::int32_t>(mesh.size());
    mesh.add_patch(back, surface, mesh.polygon[i], static_cast<std::int32_t>(i));
  }
}

}  // namespace radiosity::test

#include "tests/support/shapes.h"

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

Vec3 random_unit(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  return Vec3(normal(random), normal(random), normal(random)).normalized();
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

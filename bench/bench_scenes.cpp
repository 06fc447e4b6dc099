#include "bench_scenes.h"

#include <cmath>

namespace bench {
namespace {

using radiosity::PatchMesh;
using radiosity::Vec3;

enum class Cells { quads, triangles };

/// Appends a parallelogram a + s u + t v facing u x v as nu x nv cells of a new surface.
void add_grid(PatchMesh& mesh, const Vec3& a, const Vec3& u, const Vec3& v, long nu, long nv,
              Cells cells) {
  const auto surface = static_cast<std::int32_t>(mesh.surface_names.size());
  mesh.surface_names.push_back("surface " + std::to_string(surface));
  mesh.surface_two_sided.push_back(false);
  const auto first = static_cast<std::int32_t>(mesh.vertices.size());
  const auto place = [](long k, long n) { return static_cast<double>(k) / static_cast<double>(n); };
  for (long j = 0; j <= nv; ++j) {
    for (long i = 0; i <= nu; ++i) mesh.vertices.push_back(a + u * place(i, nu) + v * place(j, nv));
  }
  for (long j = 0; j < nv; ++j) {
    for (long i = 0; i < nu; ++i) {
      const auto c = static_cast<std::int32_t>(first + j * (nu + 1) + i);
      const auto d = static_cast<std::int32_t>(c + nu + 1);
      if (cells == Cells::quads) {
        mesh.add_patch({c, c + 1, d + 1, d}, surface, surface);
      } else {
        mesh.add_patch({c, c + 1, d + 1, -1}, surface, surface);
        mesh.add_patch({c, d + 1, d, -1}, surface, surface);
      }
    }
  }
}

}  // namespace

PatchMesh box_in_box(long n_cells) {
  PatchMesh mesh;
  const auto add_box = [&](const Vec3& low, const Vec3& high, long n, bool inwards) {
    const Vec3 x(high.x() - low.x(), 0, 0);
    const Vec3 y(0, high.y() - low.y(), 0);
    const Vec3 z(0, 0, high.z() - low.z());
    const auto add = [&](const Vec3& a, const Vec3& u, const Vec3& v) {
      add_grid(mesh, a, inwards ? u : v, inwards ? v : u, n, n, Cells::triangles);
    };
    add(low, x, y);
    add(low + z, y, x);
    add(low, y, z);
    add(low + x, z, y);
    add(low, z, x);
    add(low + y, x, z);
  };
  add_box({0, 0, 0}, {1, 1, 1}, n_cells, true);
  add_box({.35, .3, .25}, {.65, .6, .75}, n_cells / 2, false);
  return mesh;
}

PatchMesh street_canyon(long n_facets) {
  constexpr int kBuildings = 6;
  constexpr double kSide = 18;
  constexpr double kStreet = 12;
  constexpr double kPitch = kSide + kStreet;
  constexpr double kStorey = 3;
  constexpr double kArea = 87e3;  // of everything, m²
  const double cell = std::sqrt(kArea / static_cast<double>(n_facets));
  PatchMesh mesh;
  const auto count = [&](double length) { return std::max(1L, std::lround(length / cell)); };
  const auto add = [&](const Vec3& a, const Vec3& u, const Vec3& v) {
    add_grid(mesh, a, u, v, count(u.norm()), count(v.norm()), Cells::quads);
  };
  const auto add_ground = [&](double x, double y, double wide, double deep) {
    add({x, y, 0}, {wide, 0, 0}, {0, deep, 0});
  };
  for (int j = 0; j < kBuildings; ++j) {
    for (int i = 0; i < kBuildings; ++i) {
      const double x = i * kPitch;
      const double y = j * kPitch;
      const double height = kStorey * (3 + (5 * i + 7 * j + i * j) % 8);
      const Vec3 wide(kSide, 0, 0);
      const Vec3 deep(0, kSide, 0);
      const Vec3 up(0, 0, height);
      const Vec3 corner(x, y, 0);
      add(corner, wide, up);
      add(corner + wide, deep, up);
      add(corner + wide + deep, -wide, up);
      add(corner + deep, -deep, up);
      add(corner + up, wide, deep);
      add_ground(x + kSide, y, kStreet, kSide);
      add_ground(x, y + kSide, kSide, kStreet);
      add_ground(x + kSide, y + kSide, kStreet, kStreet);
    }
  }
  return mesh;
}

}  // namespace bench

#include "bench_scenes.h"

#include <algorithm>
#include <cmath>

#include "tests/support/shapes.h"

namespace bench {
namespace {

using radiosity::PatchMesh;
using radiosity::Vec3;
using radiosity::test::Facing;

/// The same surfaces with two triangles for each quad.
PatchMesh halved(const PatchMesh& quads) {
  PatchMesh result;
  result.vertices = quads.vertices;
  result.surface_names = quads.surface_names;
  result.surface_two_sided = quads.surface_two_sided;
  for (radiosity::Index i = 0; i < quads.size(); ++i) {
    const auto& c = quads.corners[i];
    result.add_patch({c[0], c[1], c[2], -1}, quads.surface[i], quads.polygon[i]);
    result.add_patch({c[0], c[2], c[3], -1}, quads.surface[i], quads.polygon[i]);
  }
  return result;
}

}  // namespace

PatchMesh box_in_box(long n_cells) {
  const auto n = static_cast<int>(n_cells);
  PatchMesh mesh;
  radiosity::test::add_box(mesh, {0, 0, 0}, {1, 1, 1}, n, Facing::inwards);
  radiosity::test::add_box(mesh, {.35, .3, .25}, {.65, .6, .75}, n / 2, Facing::outwards);
  return halved(mesh);
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
  const auto count = [&](double length) {
    return static_cast<int>(std::max(1L, std::lround(length / cell)));
  };
  const auto add = [&](const Vec3& a, const Vec3& u, const Vec3& v) {
    radiosity::test::add_grid(mesh, a, u, v, count(u.norm()), count(v.norm()));
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

#include "tests/support/symmetric_parts.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <string>

#include "tests/support/shapes.h"

namespace radiosity::test {
namespace {

std::int32_t add_surface(PatchMesh& mesh, const std::string& name) {
  mesh.surface_names.push_back(name);
  mesh.surface_two_sided.push_back(false);
  return static_cast<std::int32_t>(mesh.surface_names.size()) - 1;
}

/// A quad, or the other way round. A triangle if the last two corners are the same.
void add_quad(PatchMesh& mesh, std::int32_t surface, const std::array<Vec3, 4>& corners,
              bool is_turned) {
  const auto first = static_cast<std::int32_t>(mesh.vertices.size());
  const bool is_triangle = corners[2] == corners[3];
  mesh.vertices.insert(mesh.vertices.end(), corners.begin(), corners.end() - (is_triangle ? 1 : 0));
  std::array<std::int32_t, 4> patch{first, first + 1, first + 2, is_triangle ? -1 : first + 3};
  if (is_turned) std::swap(patch[0], patch[2]);
  mesh.add_patch(patch, surface, surface);
}

}  // namespace

std::vector<Placement> placements() {
  return {
      {},
      {Eigen::AngleAxisd(0.7, Vec3(1, 2, -3).normalized()).toRotationMatrix(), Vec3(5, -3, 2), 1},
      {Eigen::AngleAxisd(2.1, Vec3(-2, 1, 4).normalized()).toRotationMatrix(), Vec3(100, 0, -7),
       0.02},
  };
}

Symmetry placed(Symmetry symmetry, const Placement& placement) {
  for (Symmetry::Mirror& mirror : symmetry.mirrors) {
    mirror = {placement(mirror.point), placement.turn * mirror.normal};
  }
  if (symmetry.rotation) {
    symmetry.rotation->point = placement(symmetry.rotation->point);
    symmetry.rotation->axis = placement.turn * symmetry.rotation->axis;
  }
  for (Symmetry::Translation& translation : symmetry.translations) {
    translation.step = placement.scale * (placement.turn * translation.step);
  }
  return symmetry;
}

PatchMesh part_of(const PatchMesh& mesh, const Symmetry& symmetry, const Placement& placement) {
  PatchMesh part;
  for (const Vec3& vertex : mesh.vertices) part.vertices.push_back(placement(vertex));
  for (Index i = 0; i < mesh.size(); ++i) {
    part.add_patch(mesh.corners[i], mesh.surface[i], mesh.polygon[i], mesh.twin[i]);
  }
  part.surface_names = mesh.surface_names;
  part.surface_two_sided = mesh.surface_two_sided;
  part.images = image_motions(placed(symmetry, placement));
  return part;
}

Symmetry::Mirror mirror(const Vec3& normal) { return {Vec3::Zero(), normal.normalized()}; }

PatchMesh cube_corner(int n) {
  PatchMesh mesh;
  add_grid(mesh, Vec3(1, 0, 0), Vec3(0, 0, 1), Vec3(0, 1, 0), n, n);
  add_grid(mesh, Vec3(0, 1, 0), Vec3(1, 0, 0), Vec3(0, 0, 1), n, n);
  add_grid(mesh, Vec3(0, 0, 1), Vec3(0, 1, 0), Vec3(1, 0, 0), n, n);
  return mesh;
}

Symmetry three_mirrors() {
  return {{mirror(Vec3::UnitX()), mirror(Vec3::UnitY()), mirror(Vec3::UnitZ())}, {}, {}};
}

PatchMesh prism_sector(int folds, double inner, double outer, double height, int n) {
  const double half = kPi / folds;
  const auto rim = [&](double radius, double angle, double z) {
    return Vec3(radius * std::cos(angle), radius * std::sin(angle), z);
  };
  PatchMesh mesh;
  const Vec3 up(0, 0, height);
  const auto chord = [&](double radius) {
    return Vec3(rim(radius, half, 0) - rim(radius, -half, 0));
  };
  add_grid(mesh, rim(inner, -half, 0), chord(inner), up, 1, n);
  add_grid(mesh, rim(outer, half, 0), -chord(outer), up, 1, n);
  const auto add_end = [&](double z, bool is_top) {
    const std::array corners{rim(inner, -half, z), rim(outer, -half, z), rim(outer, half, z),
                             rim(inner, half, z)};
    const std::int32_t surface = add_surface(mesh, "end");
    add_quad(mesh, surface, corners, is_top);
  };
  add_end(0, false);
  add_end(height, true);
  return mesh;
}

Symmetry folds_about_z(int folds) {
  return {{}, Symmetry::Rotation{Vec3::Zero(), Vec3::UnitZ(), folds}, {}};
}

PatchMesh sphere_sector(int folds, int n, double inner, double outer) {
  const double half = kPi / folds;
  PatchMesh mesh;
  for (const bool is_outer : {false, true}) {
    const double radius = is_outer ? outer : inner;
    const auto at = [&](int k, double longitude) {
      const double polar = k == 0 ? 0 : kPi / 2 * k / n;
      const double height = k == n ? 0 : std::cos(polar);
      return Vec3(radius * Vec3(std::sin(polar) * std::cos(longitude),
                                std::sin(polar) * std::sin(longitude), height));
    };
    const std::int32_t surface = add_surface(mesh, is_outer ? "outer" : "inner");
    for (int k = 0; k < n; ++k) {
      add_quad(mesh, surface, {at(k + 1, -half), at(k + 1, half), at(k, half), at(k, -half)},
               is_outer);
    }
  }
  return mesh;
}

PatchMesh canyon_period(int n, double length) {
  PatchMesh mesh;
  const Vec3 along(0, length, 0);
  add_grid(mesh, Vec3(0, 0, 0), Vec3(1, 0, 0), along, n, 1);        // road, up
  add_grid(mesh, Vec3(0, 0, 0), along, Vec3(0, 0, 1), 1, n);        // wall, +x
  add_grid(mesh, Vec3(1, length, 0), -along, Vec3(0, 0, 1), 1, n);  // wall, -x
  return mesh;
}

}  // namespace radiosity::test

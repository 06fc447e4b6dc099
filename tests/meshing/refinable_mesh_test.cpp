#include "meshing/adaptive/refinable_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "radiosity/scene/patch_mesh.h"
#include "tests/support/shapes.h"

namespace meshing {
namespace {

using radiosity::Index;
using radiosity::PatchMesh;
using radiosity::Vec3;
using radiosity::test::add_box;
using radiosity::test::add_grid;
using radiosity::test::Facing;

double mesh_area(const PatchMesh& mesh) {
  return std::accumulate(mesh.area.begin(), mesh.area.end(), 0.0);
}

/// A floor of n x n quads, in the plane z = 0, with a turned box standing on it.
PatchMesh box_on_floor(int n) {
  PatchMesh mesh;
  add_grid(mesh, Vec3::Zero(), Vec3(1, 0, 0), Vec3(0, 1, 0), n, n);
  const Vec3 u(0.3, 0.1, 0);
  const Vec3 v(-0.1, 0.3, 0);
  const Vec3 w(0, 0, 0.4);
  const Vec3 a(0.4, 0.25, 0);
  add_grid(mesh, a, u, w, 1, 1);
  add_grid(mesh, a + u, v, w, 1, 1);
  add_grid(mesh, a + u + v, -u, w, 1, 1);
  add_grid(mesh, a + v, -v, w, 1, 1);
  add_grid(mesh, a + w, u, v, 1, 1);
  return mesh;
}

/// Inside the foot of the box; on its border counts as neither.
bool is_inside_foot(const Vec3& x, double margin) {
  const Vec3 d = x - Vec3(0.4, 0.25, 0);
  const double s = (3 * d.x() + d.y()) / 1.0;  // along u, as u.u = 0.1
  const double t = (-d.x() + 3 * d.y()) / 1.0;
  return s > margin && s < 1 - margin && t > margin && t < 1 - margin;
}

TEST(ContactLines, AreTheFootOfABox) {
  const PatchMesh mesh = box_on_floor(1);
  const auto lines = contact_lines(mesh);
  ASSERT_EQ(lines.size(), 6U);
  ASSERT_EQ(lines[0].size(), 4U);  // on the floor
  double length = 0;
  for (const Segment& line : lines[0]) length += (line[1] - line[0]).norm();
  EXPECT_NEAR(length, 4 * std::sqrt(0.1), 1e-12);
  for (std::size_t i = 1; i < lines.size(); ++i) EXPECT_TRUE(lines[i].empty()) << i;
}

TEST(ContactLines, LeaveOutWhatStandsOnTheBack) {
  PatchMesh mesh;
  add_grid(mesh, Vec3::Zero(), Vec3(0, 1, 0), Vec3(1, 0, 0), 1, 1);  // faces -z
  add_grid(mesh, Vec3(0.2, 0.5, 0), Vec3(0.5, 0, 0), Vec3(0, 0, 1), 1, 1);
  EXPECT_TRUE(contact_lines(mesh)[0].empty());
}

TEST(ContactLines, AreWherePatchesPassThroughEachOther) {
  PatchMesh mesh;
  add_grid(mesh, Vec3::Zero(), Vec3(1, 0, 0), Vec3(0, 1, 0), 1, 1);
  add_grid(mesh, Vec3(-1, 0.5, -1), Vec3(3, 0, 0), Vec3(0, 0, 2), 1, 1);
  const auto lines = contact_lines(mesh);
  ASSERT_EQ(lines[0].size(), 1U);
  // The ends may be off by what counts as touching.
  EXPECT_NEAR((lines[0][0][1] - lines[0][0][0]).norm(), 1, 2 * radiosity::plane_thickness(mesh));
  EXPECT_NEAR(lines[0][0][0].y(), 0.5, 1e-12);
}

TEST(RefinableMesh, CutsAlongTheFootOfABox) {
  for (const int n : {1, 3, 8}) {
    const PatchMesh whole = box_on_floor(n);
    const RefinableMesh cut(whole);
    EXPECT_NEAR(mesh_area(cut.mesh()), mesh_area(whole), 1e-12);
    double covered = 0;
    for (Index i = 0; i < cut.mesh().size(); ++i) {
      if (cut.mesh().surface[i] != 0) continue;
      const bool is_covered = is_inside_foot(cut.mesh().centroid[i], 0);
      if (is_covered) covered += cut.mesh().area[i];
      for (int k = 0; k < cut.mesh().n_corners(i); ++k) {
        const Vec3 x = cut.mesh().corner(i, k);
        // No patch lies on both sides: no corner is well inside another's side.
        EXPECT_FALSE(!is_covered && is_inside_foot(x, 0.02)) << x.transpose();
      }
    }
    // Slivers thinner than a hundredth of a patch may be left where they are.
    EXPECT_NEAR(covered, 0.1, 0.1 * 0.02);
  }
}

/// Whether every patch's edge is at most twice as long as the pieces of others that lie on it.
int most_points_on_an_edge(const PatchMesh& mesh) {
  int most = 0;
  for (Index i = 0; i < mesh.size(); ++i) {
    const int n = mesh.n_corners(i);
    for (int k = 0; k < n; ++k) {
      const Vec3& a = mesh.corner(i, k);
      const Vec3 ab = mesh.corner(i, (k + 1) % n) - a;
      std::vector<double> points;
      for (Index j = 0; j < mesh.size(); ++j) {
        if (mesh.surface[j] != mesh.surface[i]) continue;
        for (int c = 0; c < mesh.n_corners(j); ++c) {
          const Vec3 d = mesh.corner(j, c) - a;
          const double t = d.dot(ab) / ab.squaredNorm();
          if (t < 1e-6 || t > 1 - 1e-6 || (d - t * ab).norm() > 1e-9) continue;
          if (std::none_of(points.begin(), points.end(),
                           [&](double p) { return std::abs(p - t) < 1e-9; })) {
            points.push_back(t);
          }
        }
      }
      most = std::max(most, static_cast<int>(points.size()));
    }
  }
  return most;
}

TEST(RefinableMesh, StaysBalanced) {
  PatchMesh mesh;
  add_grid(mesh, Vec3::Zero(), Vec3(1, 0, 0), Vec3(0, 1, 0), 3, 3);
  const auto first = static_cast<std::int32_t>(mesh.vertices.size());
  for (const Vec3& x : {Vec3(0, 0, 1), Vec3(1, 0, 1), Vec3(0, 1, 1), Vec3(1, 1, 1)}) {
    mesh.vertices.push_back(x);
  }
  mesh.surface_names.emplace_back("triangles");
  mesh.surface_two_sided.push_back(false);
  mesh.add_patch({first, first + 1, first + 2, -1}, 1, 1);
  mesh.add_patch({first + 1, first + 3, first + 2, -1}, 1, 1);
  RefinableMesh refinable(mesh);
  std::mt19937_64 random(5);
  for (int round = 0; round < 6; ++round) {
    const PatchMesh before = refinable.mesh();
    std::vector<Index> marked;
    // Towards a corner, and here and there.
    for (Index i = 0; i < before.size(); ++i) {
      if (before.centroid[i].head<2>().norm() < std::pow(0.5, round) || random() % 16 == 0) {
        marked.push_back(i);
      }
    }
    const std::vector<std::int32_t> earlier = refinable.refine(marked);
    const PatchMesh& after = refinable.mesh();
    ASSERT_EQ(static_cast<Index>(earlier.size()), after.size());
    for (Index i = 0; i < after.size(); ++i) {
      if (earlier[i] < 0) {
        EXPECT_GE(after.family[i], 0);
        continue;
      }
      EXPECT_EQ(after.centroid[i], before.centroid[earlier[i]]);
      EXPECT_EQ(after.area[i], before.area[earlier[i]]);
    }
    for (const Index i : marked) {
      EXPECT_EQ(std::count(earlier.begin(), earlier.end(), i), 0) << "not divided";
    }
    EXPECT_NEAR(mesh_area(after), mesh_area(mesh), 1e-12);
    EXPECT_LE(most_points_on_an_edge(after), 1);
  }
}

TEST(RefinableMesh, DividesTwinsAlike) {
  PatchMesh mesh;
  add_grid(mesh, Vec3::Zero(), Vec3(1, 0, 0), Vec3(0, 1, 0), 2, 2);
  radiosity::test::make_two_sided(mesh, 0);
  RefinableMesh refinable(mesh);
  refinable.refine(std::vector<Index>{0, 3});
  refinable.refine(std::vector<Index>{1});
  const PatchMesh& after = refinable.mesh();
  EXPECT_NEAR(mesh_area(after), 2, 1e-12);
  for (Index i = 0; i < after.size(); ++i) {
    ASSERT_GE(after.twin[i], 0);
    EXPECT_EQ(after.twin[after.twin[i]], i);
    EXPECT_LT((after.centroid[i] - after.centroid[after.twin[i]]).norm(), 1e-14);
    EXPECT_EQ(after.normal[i], -after.normal[after.twin[i]]);
  }
}

}  // namespace
}  // namespace meshing

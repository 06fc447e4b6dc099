// Regions that nothing leads between: walls of two sheets back to back, and
// what opens them.
#include "radiosity/visibility/regions.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <random>
#include <vector>

#include "radiosity/scene/patch_mesh.h"
#include "radiosity/visibility/visibility.h"
#include "tests/support/shapes.h"

namespace radiosity {
namespace {

using test::add_box;
using test::Facing;

/// As many quads along each edge.
struct Divisions {
  int room;
  int outside;
  int inside;
};

constexpr Divisions kDivisions[] = {{1, 1, 1}, {2, 1, 1}, {1, 3, 3}, {3, 2, 1}, {2, 2, 3}};

/// The mesh without the patches of some surfaces, turned, moved and rounded to
/// `digit`.
PatchMesh placed(const PatchMesh& mesh, const std::vector<std::int32_t>& left_out,
                 const Eigen::Isometry3d& motion, double digit) {
  PatchMesh result;
  for (const Vec3& x : mesh.vertices) {
    const Vec3 moved = motion * x;
    result.vertices.emplace_back(digit * (moved / digit).array().round());
  }
  result.surface_names = mesh.surface_names;
  result.surface_two_sided = mesh.surface_two_sided;
  for (Index i = 0; i < mesh.size(); ++i) {
    if (std::find(left_out.begin(), left_out.end(), mesh.surface[i]) != left_out.end()) continue;
    result.add_patch(mesh.corners[i], mesh.surface[i], mesh.polygon[i]);
  }
  result.precision = digit;
  return result;
}

/// A room, surfaces 0 to 5, and in it a cupboard without thickness: its faces
/// seen from outside, 6 to 11, and from inside, 12 to 17.
PatchMesh room_with_cupboard(const Divisions& n) {
  PatchMesh mesh;
  add_box(mesh, Vec3(0, 0, 0), Vec3(4, 3, 2.5), n.room, Facing::inwards);
  add_box(mesh, Vec3(1, 1, 0.5), Vec3(2.2, 1.7, 1.6), n.outside, Facing::outwards);
  add_box(mesh, Vec3(1, 1, 0.5), Vec3(2.2, 1.7, 1.6), n.inside, Facing::inwards);
  return mesh;
}

std::vector<Eigen::Isometry3d> motions() {
  std::vector<Eigen::Isometry3d> result(2, Eigen::Isometry3d::Identity());
  result[1].rotate(Eigen::AngleAxisd(0.7, Vec3(1, 2, -3).normalized()));
  result[1].pretranslate(Vec3(20, -30, 7));
  return result;
}

std::vector<std::int32_t> regions_of(const PatchMesh& mesh) {
  return find_regions(mesh, Visibility(mesh), plane_thickness(mesh));
}

void expect_shut(const PatchMesh& mesh, bool is_shut) {
  const std::vector<std::int32_t> regions = regions_of(mesh);
  for (Index i = 0; i < mesh.size(); ++i) {
    const bool is_inside = is_shut && mesh.surface[i] >= 12;
    EXPECT_EQ(regions[i] != regions[0], is_inside) << "surface " << mesh.surface[i];
  }
}

TEST(Regions, TwoSheetsBackToBackShutACupboard) {
  for (const Divisions& n : kDivisions) {
    for (const Eigen::Isometry3d& motion : motions()) {
      for (const double digit : {1e-12, 1e-6}) {
        expect_shut(placed(room_with_cupboard(n), {}, motion, digit), true);
        // One of the sheets does.
        expect_shut(placed(room_with_cupboard(n), {6}, motion, digit), true);
        expect_shut(placed(room_with_cupboard(n), {15}, motion, digit), true);
      }
    }
  }
}

TEST(Regions, OpenCupboardsAreOfTheRoom) {
  for (const Divisions& n : kDivisions) {
    for (const Eigen::Isometry3d& motion : motions()) {
      for (std::int32_t face = 0; face < 6; ++face) {
        expect_shut(placed(room_with_cupboard(n), {6 + face, 12 + face}, motion, 1e-6), false);
      }
    }
  }
}

/// Rooms beside each other that share a wall of two sheets, the second one less
/// deep, with a part of the wall that is missing on one side or both.
PatchMesh two_rooms(bool first_is_whole, bool second_is_whole) {
  PatchMesh mesh;
  add_box(mesh, Vec3(0, 0, 0), Vec3(2, 3, 2), 2, Facing::inwards);
  add_box(mesh, Vec3(2, 0, 0), Vec3(4, 3, 2), 3, Facing::inwards);
  PatchMesh result;
  result.vertices = mesh.vertices;
  result.surface_names = mesh.surface_names;
  result.surface_two_sided = mesh.surface_two_sided;
  for (Index i = 0; i < mesh.size(); ++i) {
    const bool is_low = mesh.centroid[i].z() < 1 && mesh.centroid[i].y() < 1.5;
    if (mesh.surface[i] == 3 && is_low && !first_is_whole) continue;
    if (mesh.surface[i] == 8 && is_low && !second_is_whole) continue;
    result.add_patch(mesh.corners[i], mesh.surface[i], mesh.polygon[i]);
  }
  return result;
}

TEST(Regions, AWallOfTwoSheetsIsOpenWhereBothAre) {
  for (const bool first : {false, true}) {
    for (const bool second : {false, true}) {
      const PatchMesh rooms = two_rooms(first, second);
      const std::vector<std::int32_t> regions = regions_of(rooms);
      EXPECT_EQ(regions.front() != regions.back(), first && second) << first << second;
    }
  }
}

// Whatever lies on what, points that see each other are of one region.
TEST(Regions, NeverPartWhatASegmentJoins) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  int n_seen = 0;
  for (int k = 0; k < 20; ++k) {
    PatchMesh mesh;
    // Boxes on a lattice, so that many faces, edges and corners lie on each
    // other.
    const auto whole = [&](int most) { return static_cast<int>(unit(random) * (most + 1)); };
    for (int b = 0; b < 7; ++b) {
      const Vec3 low(whole(3), whole(3), whole(3));
      const Vec3 size(1 + whole(2), 1 + whole(2), 1 + whole(2));
      add_box(mesh, low, low + size, 1 + whole(1),
              unit(random) < 0.5 ? Facing::inwards : Facing::outwards);
    }
    std::vector<std::int32_t> left_out;
    for (std::int32_t s = 0; s < 42; ++s) {
      if (unit(random) < 0.15) left_out.push_back(s);
    }
    const PatchMesh boxes = placed(mesh, left_out, motions()[k % 2], 1e-9);
    const Visibility visibility(boxes);
    const auto regions = find_regions(boxes, visibility, plane_thickness(boxes));
    for (int ray = 0; ray < 20000; ++ray) {
      const auto i = static_cast<std::int32_t>(unit(random) * static_cast<double>(boxes.size()));
      // Well within the patch: rays pass by what is closer to their ends than
      // their gap.
      const double s = 0.05 + 0.9 * unit(random);
      const double t = 0.05 + 0.9 * unit(random);
      const Vec3 a = boxes.corner(i, 0);
      const Vec3 from = a + s * (boxes.corner(i, 1) - a) + t * (boxes.corner(i, 3) - a);
      Vec3 way = test::random_unit(random);
      if (way.dot(boxes.normal[i]) < 0) way = -way;
      const auto hit = visibility.first_hit(from, way, i);
      if (!hit || !hit->front) continue;
      ++n_seen;
      ASSERT_EQ(regions[i], regions[hit->patch]) << k << " from " << i << " to " << hit->patch;
    }
  }
  EXPECT_GT(n_seen, 50000);
}

}  // namespace
}  // namespace radiosity

// Regions that nothing leads between: walls of two sheets back to back, and
// what opens them.
#include "radiosity/visibility/regions.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <set>
#include <string>
#include <utility>
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

// One sheet that is left shuts it.
TEST(Regions, AWallOfTwoSheetsIsOpenWhereBothAre) {
  for (const bool first : {false, true}) {
    for (const bool second : {false, true}) {
      const PatchMesh rooms = two_rooms(first, second);
      const std::vector<std::int32_t> regions = regions_of(rooms);
      EXPECT_EQ(regions.front() != regions.back(), first || second) << first << second;
    }
  }
}

/// Lines that divide a length of 1, at random.
std::vector<double> random_lines(std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  const int n = 1 + static_cast<int>(3 * unit(random));
  std::vector<double> lines;
  for (int k = 0; k <= n; ++k) {
    const bool is_end = k == 0 || k == n;
    lines.push_back((k + (is_end ? 0 : 0.6 * (unit(random) - 0.5))) / n);
  }
  return lines;
}

/// Adds a parallelogram, its normal u x v, divided at random into quads and triangles.
void add_divided(PatchMesh& mesh, const Vec3& a, const Vec3& u, const Vec3& v, std::int32_t surface,
                 std::mt19937_64& random) {
  const std::vector<double> along_u = random_lines(random);
  const std::vector<double> along_v = random_lines(random);
  for (std::size_t s = 0; s + 1 < along_u.size(); ++s) {
    for (std::size_t t = 0; t + 1 < along_v.size(); ++t) {
      const auto first = static_cast<std::int32_t>(mesh.vertices.size());
      for (const auto& [i, j] : {std::pair(s, t), {s + 1, t}, {s + 1, t + 1}, {s, t + 1}}) {
        mesh.vertices.emplace_back(a + along_u[i] * u + along_v[j] * v);
      }
      const std::int32_t polygon = surface;
      const int kind = static_cast<int>(random() % 3);
      if (kind == 0) {
        mesh.add_patch({first, first + 1, first + 2, first + 3}, surface, polygon);
        continue;
      }
      const std::int32_t o = kind - 1;
      const auto at = [&](std::int32_t k) { return first + (k + o) % 4; };
      mesh.add_patch({at(0), at(1), at(2), -1}, surface, polygon);
      mesh.add_patch({at(0), at(2), at(3), -1}, surface, polygon);
    }
  }
}

/// Adds the faces of a box, each divided at random, as one surface.
void add_divided_box(PatchMesh& mesh, const Vec3& low, const Vec3& high, Facing facing,
                     std::mt19937_64& random) {
  const auto surface = static_cast<std::int32_t>(mesh.surface_names.size());
  mesh.surface_names.emplace_back("box");
  mesh.surface_two_sided.push_back(false);
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 u = Vec3::Zero();
    Vec3 v = Vec3::Zero();
    u[(axis + 1) % 3] = high[(axis + 1) % 3] - low[(axis + 1) % 3];
    v[(axis + 2) % 3] = high[(axis + 2) % 3] - low[(axis + 2) % 3];
    for (const bool is_high : {false, true}) {
      Vec3 a = low;
      if (is_high) a[axis] = high[axis];
      if (is_high == (facing == Facing::outwards)) {
        add_divided(mesh, a, u, v, surface, random);
      } else {
        add_divided(mesh, a, v, u, surface, random);
      }
    }
  }
}

/// Checks that patches look into the same region if they are of the same part.
void expect_parts(const PatchMesh& mesh, const std::vector<std::int32_t>& part_of_surface,
                  const std::string& what) {
  const std::vector<std::int32_t> regions = regions_of(mesh);
  std::map<std::int32_t, std::int32_t> region_of_part;
  for (Index i = 0; i < mesh.size(); ++i) {
    const std::int32_t part = part_of_surface[mesh.surface[i]];
    const std::int32_t region = region_of_part.try_emplace(part, regions[i]).first->second;
    ASSERT_EQ(regions[i], region) << what << ": patch " << i << " of part " << part;
  }
  std::set<std::int32_t> numbers;
  for (const auto& [part, region] : region_of_part) numbers.insert(region);
  EXPECT_EQ(numbers.size(), region_of_part.size()) << what;
}

Eigen::Isometry3d turned_at_random(std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.rotate(Eigen::AngleAxisd(3 * unit(random), test::random_unit(random)));
  motion.pretranslate(30 * test::random_unit(random));
  return motion;
}

// Cupboards, and boxes that stand on a part of each other's walls or beyond their edges, in a room.
TEST(Regions, SheetsDividedUnlikeThatOverlapInPartShutRooms) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int k = 0; k < 60; ++k) {
    PatchMesh mesh;
    const auto random_vec = [&] { return Vec3(unit(random), unit(random), unit(random)); };
    add_divided_box(mesh, Vec3(-2, -2, -2), Vec3(6, 6, 6), Facing::inwards, random);
    const Vec3 high = Vec3(1.5, 1.5, 1) + random_vec();
    add_divided_box(mesh, Vec3::Zero(), high, Facing::inwards, random);
    Vec3 low(2 * unit(random) - 0.6, 2 * unit(random) - 0.6, high.z());
    if (k % 4 == 0) low.x() = 0;
    add_divided_box(mesh, low, low + Vec3(0.7, 0.7, 0.7) + random_vec(), Facing::inwards, random);
    std::vector<std::int32_t> part{0, 1, 2};
    if (k % 2 == 0) {
      const Vec3 cupboard = Vec3(-1.5, -1.5, -1.5) + 0.3 * random_vec();
      const Vec3 to = cupboard + Vec3(0.4, 0.4, 0.4) + 0.5 * random_vec();
      add_divided_box(mesh, cupboard, to, Facing::outwards, random);
      add_divided_box(mesh, cupboard, to, Facing::inwards, random);
      part.insert(part.end(), {0, 3});
    }
    const double digit = std::array{1e-12, 1e-6, 1e-5}[k % 3];
    expect_parts(placed(mesh, {}, turned_at_random(random), digit), part, std::to_string(k));
  }
}

// Shelves of one or two sheets that end on walls, which go on beyond them.
TEST(Regions, SheetsThatStandOnOthersPartWhatLooksPastThem) {
  std::mt19937_64 random(12);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int k = 0; k < 30; ++k) {
    PatchMesh mesh;
    const double height = 0.5 + unit(random);
    // Walls from below to above, but for one: what looks into it sees both rooms.
    const bool is_split = k % 2 == 0;
    const auto add = [&](const Vec3& low, const Vec3& high) {
      add_divided_box(mesh, low, high, Facing::inwards, random);
    };
    add(Vec3::Zero(), Vec3(2, 2, height));
    add(Vec3(0, 0, height), Vec3(2, 2, 2));
    if (!is_split) {
      // A plate through the wall between them.
      add_divided(mesh, Vec3(0.5, 0.5, height - 0.2), Vec3(0.7, 0, 0), Vec3(0, 0, 0.4), 0, random);
    }
    const PatchMesh rooms = placed(mesh, {}, turned_at_random(random), k % 3 == 0 ? 1e-12 : 1e-6);
    const std::vector<std::int32_t> regions = regions_of(rooms);
    const bool are_parted = *std::max_element(regions.begin(), regions.end()) > 0;
    EXPECT_EQ(are_parted, is_split) << k;
  }
}

/// Checks that rays from patches end on such as look into the same region, and tells how many.
int expect_joined(const PatchMesh& mesh, std::mt19937_64& random, const std::string& what) {
  std::uniform_real_distribution<double> unit(0, 1);
  const Visibility visibility(mesh);
  const auto regions = find_regions(mesh, visibility, plane_thickness(mesh));
  int n_seen = 0;
  for (int ray = 0; ray < 20000; ++ray) {
    const auto i = static_cast<std::int32_t>(unit(random) * static_cast<double>(mesh.size()));
    // Well within the patch: rays pass by what is closer to their ends than their gap.
    Vec3 from = triangle_point(mesh.corner(i, 0), mesh.corner(i, 1), mesh.corner(i, 2),
                               unit(random), unit(random));
    from += 0.1 * (mesh.centroid[i] - from);
    Vec3 way = test::random_unit(random);
    if (way.dot(mesh.normal[i]) < 0) way = -way;
    const auto hit = visibility.first_hit(from, way, i);
    if (!hit || !hit->front) continue;
    ++n_seen;
    if (regions[i] == regions[hit->patch]) continue;
    ADD_FAILURE() << what << " from " << i << " to " << hit->patch;
    break;
  }
  return n_seen;
}

// Plates on a lattice, many of them crossing, abutting or lying on each other.
TEST(Regions, NeverPartWhatASegmentJoinsBetweenPlates) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  const auto whole = [&](int most) { return static_cast<int>(unit(random) * (most + 1)); };
  int n_seen = 0;
  for (int k = 0; k < 30; ++k) {
    PatchMesh mesh;
    mesh.surface_names.emplace_back("plates");
    mesh.surface_two_sided.push_back(false);
    const int n_plates = 8 + whole(16);
    for (int p = 0; p < n_plates; ++p) {
      const int axis = whole(2);
      Vec3 u = Vec3::Zero();
      Vec3 v = Vec3::Zero();
      u[(axis + 1) % 3] = 1 + whole(2);
      v[(axis + 2) % 3] = 1 + whole(2);
      if (unit(random) < 0.5) std::swap(u, v);
      add_divided(mesh, Vec3(whole(3), whole(3), whole(3)), u, v, 0, random);
    }
    const PatchMesh plates = placed(mesh, {}, turned_at_random(random), k % 2 == 0 ? 1e-12 : 1e-6);
    n_seen += expect_joined(plates, random, std::to_string(k));
  }
  EXPECT_GT(n_seen, 50000);
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
    n_seen += expect_joined(boxes, random, std::to_string(k));
  }
  EXPECT_GT(n_seen, 50000);
}

}  // namespace
}  // namespace radiosity

#include "meshing/patches/contact_cuts.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "io/base/rounding.h"
#include "io/scene/scene_file.h"
#include "meshing/patches/patches.h"
#include "radiosity/assembly/transport_options.h"
#include "radiosity/compressed/make_transport.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/radiometry.h"
#include "radiosity/solve/discretisation_error.h"
#include "radiosity/solve/solution.h"
#include "radiosity/solve/solve.h"
#include "radiosity/visibility/regions.h"
#include "radiosity/visibility/visibility.h"
#include "tests/support/hung_boxes.h"
#include "tests/support/walled_rooms.h"

namespace {

using namespace radiosity;
using meshing::make_patches;
using test::Hut;
using test::WalledRoom;

double total_area(const PatchMesh& mesh) {
  return std::accumulate(mesh.area.begin(), mesh.area.end(), 0.0);
}

/// Number of corners of patches that lie within an edge of another patch of the same polygon.
int count_t_vertices(const PatchMesh& mesh) {
  int count = 0;
  for (Index i = 0; i < mesh.size(); ++i) {
    for (Index j = 0; j < mesh.size(); ++j) {
      if (mesh.polygon[i] != mesh.polygon[j]) continue;
      for (int k = 0; k < mesh.n_corners(i); ++k) {
        const Vec3& a = mesh.corner(i, k);
        const Vec3 ab = mesh.corner(i, (k + 1) % mesh.n_corners(i)) - a;
        for (int c = 0; c < mesh.n_corners(j); ++c) {
          const Vec3 d = mesh.corner(j, c) - a;
          const double t = d.dot(ab) / ab.squaredNorm();
          if (t > 1e-9 && t < 1 - 1e-9 && (d - t * ab).norm() < 1e-9) ++count;
        }
      }
    }
  }
  return count;
}

Solution solve_patches(const Scene& scene, const PatchMesh& mesh, Closed closed = Closed::no) {
  const Visibility visibility(mesh);
  const auto transport = make_transport(mesh, visibility, {.tolerance = 1e-3, .closed = closed});
  const Solution solution = solve(*transport, exitance(scene, mesh), reflectance(scene, mesh));
  return with_discretisation_error(solution, discretisation_error(mesh, *transport, solution));
}

/// Kinds by seed: sheets and boards (every third), turned (odd ones), all digits, 5 decimals and
/// single precision. bench/walled_rooms_bench does more.
class WalledRooms : public testing::TestWithParam<std::uint64_t> {};
INSTANTIATE_TEST_SUITE_P(Seeds, WalledRooms, testing::Values(1, 2, 3, 11));

TEST_P(WalledRooms, AreCutAndConform) {
  const WalledRoom room = test::make_walled_room(GetParam(), Hut::sealed);
  const PatchMesh as_is = make_patches(room.scene);
  EXPECT_FALSE(meshing::crossed_patches(as_is).empty());
  for (const long n : {100, 400}) {
    const PatchMesh mesh = make_patches(room.scene, {.n_patches = n});
    EXPECT_TRUE(meshing::crossed_patches(mesh).empty()) << n;
    EXPECT_NEAR(total_area(mesh), total_area(as_is), 1e-9 * total_area(as_is));
    EXPECT_EQ(count_t_vertices(mesh), 0) << n;
    EXPECT_GT(*std::min_element(mesh.area.begin(), mesh.area.end()), 0);
    for (Index i = 0; i < mesh.size(); ++i) {
      EXPECT_EQ(mesh.twin[i] >= 0, room.scene.surfaces[mesh.surface[i]].two_sided);
      if (mesh.twin[i] >= 0) {
        EXPECT_EQ(mesh.twin[mesh.twin[i]], i);
      }
    }
  }
  const PatchMesh asked = make_patches(room.scene, {.n_patches = 700});
  EXPECT_NEAR(static_cast<double>(asked.size()), 700, 0.05 * 700);
  EXPECT_EQ(make_patches(room.scene, {.n_patches = 700}).corners, asked.corners);
}

TEST_P(WalledRooms, AreDarkWithin) {
  const WalledRoom room = test::make_walled_room(GetParam(), Hut::sealed);
  const PatchMesh mesh = make_patches(room.scene, {.n_patches = 300});
  const Solution solution = solve_patches(room.scene, mesh);
  Index n_inside = 0;
  for (Index i = 0; i < mesh.size(); ++i) {
    if (!room.looks_inside(mesh, i)) continue;
    ++n_inside;
    EXPECT_EQ(solution.irradiance(i, 0), 0) << mesh.surface_names[mesh.surface[i]];
    EXPECT_EQ(solution.radiosity_error(i, 0), 0);
  }
  EXPECT_GT(n_inside, 10);
  EXPECT_GT(solution.irradiance.mean(), 1);
}

TEST_P(WalledRooms, ErrorsCoverFinerPatchesWhereTheyAreOpen) {
  const WalledRoom room = test::make_walled_room(GetParam(), Hut::open);
  const PatchMesh mesh = make_patches(room.scene, {.n_patches = 150});
  const Solution solution = solve_patches(room.scene, mesh);
  const PatchMesh finer = test::divided_into_four(mesh);
  const Eigen::MatrixXd truth =
      test::means_of_four(finer, solve_patches(room.scene, finer).radiosity);
  const double rounding = 1e-9 * solution.radiosity.maxCoeff();
  Index n_bright = 0;
  for (Index i = 0; i < mesh.size(); ++i) {
    n_bright += room.looks_inside(mesh, i) && truth(i, 0) > 0 ? 1 : 0;
  }
  EXPECT_GE(static_cast<double>(test::check_intervals(solution, truth, rounding).n_within),
            0.95 * static_cast<double>(mesh.size()));
  EXPECT_GT(n_bright, 0);
}

/// Straight lines between regions would disprove them.
TEST_P(WalledRooms, RegionsDoNotSeeEachOther) {
  for (const Hut hut : {Hut::sealed, Hut::open}) {
    const WalledRoom room = test::make_walled_room(GetParam(), hut);
    const PatchMesh mesh = make_patches(room.scene, {.n_patches = 300});
    const Visibility visibility(mesh);
    const std::vector<std::int32_t> region = find_regions(mesh, visibility, plane_thickness(mesh));
    std::mt19937_64 random(GetParam());
    std::normal_distribution<double> normal;
    for (Index i = 0; i < mesh.size(); ++i) {
      for (int k = 0; k < 100; ++k) {
        Vec3 direction(normal(random), normal(random), normal(random));
        if (direction.dot(mesh.normal[i]) < 0) direction = -direction;
        const auto hit = visibility.first_hit(mesh.centroid[i], direction, static_cast<int>(i));
        if (hit && hit->front) {
          EXPECT_EQ(region[hit->patch], region[i]) << i;
        }
      }
    }
  }
}

enum class Digits { all, six, single };

Scene read_turned(const std::string& name, Digits digits) {
  Scene scene = io::read_scene(RADIOSITY_TEST_DATA "/accuracy/" + name + ".json");
  const Eigen::AngleAxisd turn(0.7, Vec3(1, 2, 3).normalized());
  for (Vec3& vertex : scene.vertices) {
    vertex = turn * vertex;
    for (double& x : vertex) {
      if (digits == Digits::six) x = std::round(x * 1e5) / 1e5;
      if (digits == Digits::single) x = static_cast<float>(x);
    }
  }
  if (digits != Digits::all) scene.precision = io::found_rounding(scene.vertices).precision;
  return scene;
}

TEST(Leak, IsDarkInTheSealedBox) {
  std::vector<Scene> scenes = {io::read_scene(RADIOSITY_TEST_DATA "/accuracy/leak.json")};
  for (const Digits digits : {Digits::all, Digits::six, Digits::single}) {
    scenes.push_back(read_turned("leak", digits));
  }
  for (const Scene& scene : scenes) {
    for (const long n : {120, 600}) {
      const PatchMesh mesh = make_patches(scene, {.n_patches = n});
      const Solution solution = solve_patches(scene, mesh);
      Index n_probe = 0;
      for (Index i = 0; i < mesh.size(); ++i) {
        if (mesh.surface_names[mesh.surface[i]] != "probe") continue;
        ++n_probe;
        EXPECT_EQ(solution.irradiance(i, 0), 0) << scene.precision << " " << n;
        EXPECT_EQ(solution.radiosity_error(i, 0), 0);
      }
      EXPECT_GE(n_probe, 2);
    }
  }
}

TEST(CrossingBoxes, HaveErrorsThatCoverFinerPatches) {
  const Scene scene = io::read_scene(RADIOSITY_TEST_DATA "/accuracy/error-bars-boxes.json");
  const PatchMesh mesh = make_patches(scene, {.n_patches = 350});
  const Solution solution = solve_patches(scene, mesh, Closed::yes);
  const PatchMesh finer = test::divided_into_four(mesh);
  const Eigen::MatrixXd truth =
      test::means_of_four(finer, solve_patches(scene, finer, Closed::yes).radiosity);
  const double rounding = 1e-9 * solution.radiosity.maxCoeff();
  const Index n_within = test::check_intervals(solution, truth, rounding).n_within;
  EXPECT_GE(static_cast<double>(n_within), 0.95 * static_cast<double>(mesh.size()))
      << n_within << " of " << mesh.size();
}

template <std::size_t N>
void add(Scene& scene, const std::array<Vec3, N>& corners, std::int32_t surface) {
  std::array<std::int32_t, N> polygon;
  std::iota(polygon.begin(), polygon.end(), static_cast<std::int32_t>(scene.vertices.size()));
  scene.vertices.insert(scene.vertices.end(), corners.begin(), corners.end());
  scene.add_polygon(polygon, surface);
}

/// A room of 12 triangles with a mesh of many in it: the large ones are divided, no others.
TEST(DefaultPatches, AreSmallBesideManyPolygons) {
  Scene scene;
  scene.materials.emplace_back();
  scene.surfaces = {{"walls", 0, false}, {"bumps", 0, false}};
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 u = 4 * Vec3::Unit((axis + 1) % 3);
    const Vec3 v = 4 * Vec3::Unit((axis + 2) % 3);
    const Vec3 w = 4 * Vec3::Unit(axis);
    add<3>(scene, {Vec3::Zero(), u, u + v}, 0);
    add<3>(scene, {Vec3::Zero(), u + v, v}, 0);
    add<3>(scene, {w, w + u + v, w + u}, 0);
    add<3>(scene, {w, w + v, w + u + v}, 0);
  }
  constexpr int kSide = 32;
  for (int i = 0; i < kSide; ++i) {
    for (int j = 0; j < kSide; ++j) {
      const auto at = [](int x, int y) {
        return Vec3(1.5 + x / 32.0, 1.5 + y / 32.0, 1 + 0.01 * std::sin(x) * std::cos(y));
      };
      add<3>(scene, {at(i, j), at(i + 1, j), at(i + 1, j + 1)}, 1);
      add<3>(scene, {at(i, j), at(i + 1, j + 1), at(i, j + 1)}, 1);
    }
  }
  ASSERT_GE(scene.n_polygons(), meshing::kDefaultPatches);
  const PatchMesh mesh = make_patches(scene, meshing::make_patch_options({}, scene));
  const auto n_of = [&](std::int32_t s) {
    return std::count(mesh.surface.begin(), mesh.surface.end(), s);
  };
  EXPECT_EQ(n_of(1), 2 * kSide * kSide);
  EXPECT_NEAR(static_cast<double>(n_of(0)), meshing::kDefaultBeyondPolygons,
              0.1 * meshing::kDefaultBeyondPolygons);

  // Polygons that are all alike stay as they are.
  Scene bumps = scene;
  bumps.polygon_surface.erase(bumps.polygon_surface.begin(), bumps.polygon_surface.begin() + 12);
  bumps.corners.erase(bumps.corners.begin(), bumps.corners.begin() + 36);
  bumps.first_corner.resize(bumps.polygon_surface.size() + 1);
  EXPECT_EQ(make_patches(bumps, meshing::make_patch_options({}, bumps)).size(), bumps.n_polygons());
}

/// A floor and on it two rows of walls that stand in the same lines, one divided into few pieces
/// and one into many, all coordinates rounded to `digit`.
Scene floor_with_two_rows(double angle, double digit) {
  Scene scene;
  scene.materials.emplace_back();
  scene.surfaces = {{"floor", 0, false}, {"few", 0, false}, {"many", 0, false}};
  const Eigen::AngleAxisd turn(0.9, Vec3(2, -1, 1.5).normalized());
  const auto add_rounded = [&](std::array<Vec3, 4> corners, std::int32_t surface) {
    for (Vec3& corner : corners) {
      corner = turn * corner;
      for (double& x : corner) x = std::round(x / digit) * digit;
    }
    add<4>(scene, corners, surface);
  };
  add_rounded({Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(4, 3, 0), Vec3(0, 3, 0)}, 0);
  const Vec3 start(0.7, 0.8, 0);
  const Vec3 along(2.3 * std::cos(angle), 2.3 * std::sin(angle), 0);
  for (const auto& [surface, n] : {std::pair(1, 2), std::pair(2, 40)}) {
    for (int k = 0; k < n; ++k) {
      Vec3 a = start + k * along / n;
      Vec3 b = start + (k + 1) * along / n;
      if (surface == 2) std::swap(a, b);
      add_rounded({a, b, b + Vec3::UnitZ(), a + Vec3::UnitZ()}, surface);
    }
  }
  scene.precision = digit / 2;
  return scene;
}

// Lines that rounding has moved apart do not cut slivers out between them.
TEST(ContactCuts, LinesAreOneAsFarAsTheyAreKnown) {
  constexpr double kDigit = 1e-5;
  for (int k = 0; k < 12; ++k) {
    const Scene scene = floor_with_two_rows(0.05 * k, kDigit);
    const PatchMesh mesh = make_patches(scene, {.n_patches = 150});
    for (Index i = 0; i < mesh.size(); ++i) {
      if (mesh.surface[i] != 0) continue;
      double longest = 0;
      for (int m = 0; m < mesh.n_corners(i); ++m) {
        const Vec3& next = mesh.corner(i, (m + 1) % mesh.n_corners(i));
        longest = std::max(longest, (next - mesh.corner(i, m)).norm());
      }
      EXPECT_GT(mesh.area[i] / longest, 20 * kDigit) << k << ": " << i;
    }
  }
}

// What is too thin to be cut off is told.
TEST(ContactCuts, TellWhatTheyCannotCut) {
  Scene scene;
  scene.materials.emplace_back();
  scene.surfaces = {{"floor", 0, false}, {"wall", 0, true}};
  add<4>(scene, {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)}, 0);
  add<4>(scene, {Vec3(0.5, 0, 0), Vec3(0.5, 1, 0), Vec3(0.5, 1, 1), Vec3(0.5, 0, 1)}, 1);
  EXPECT_TRUE(meshing::uncut_warning(make_patches(scene)).has_value());
  EXPECT_FALSE(meshing::uncut_warning(make_patches(scene, {.n_patches = 20})).has_value());
  EXPECT_NE(meshing::uncut_warning(make_patches(scene))->find("floor"), std::string::npos);
}

}  // namespace

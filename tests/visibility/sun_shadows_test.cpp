// What the sun reaches: shadows in closed form, laws, and rays in double precision one by one.
#include "radiosity/visibility/sun_shadows.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "meshing/patches/patches.h"
#include "radiosity/base/parallel.h"
#include "tests/support/scene_families.h"
#include "tests/support/scene_variations.h"
#include "tests/support/shapes.h"

namespace radiosity {
namespace {

using test::add_box;
using test::add_grid;
using test::Facing;

/// Both sides of the comparison are sums over at most a thousand pieces of order 1, each off by
/// some roundings, and by the width of what counts as a border (1e-14 of the size).
constexpr double kExact = 1e-11;

/// Moves and turns a mesh.
void transform(PatchMesh& mesh, const Eigen::Isometry3d& motion) {
  for (Vec3& vertex : mesh.vertices) vertex = motion * vertex;
  for (Vec3& centroid : mesh.centroid) centroid = motion * centroid;
  for (Vec3& normal : mesh.normal) normal = motion.linear() * normal;
}

Eigen::Isometry3d random_motion(std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.translate(3 * Vec3(uniform(random), uniform(random), uniform(random)));
  motion.rotate(Eigen::AngleAxisd(3 * uniform(random), test::random_unit(random)));
  return motion;
}

/// Area of a surface that lies in the dark.
double dark_area(const PatchMesh& mesh, const Eigen::VectorXd& shares, std::int32_t surface) {
  double sum = 0;
  for (Index i = 0; i < mesh.size(); ++i) {
    if (mesh.surface[i] == surface) sum += mesh.area[i] * (1 - shares[i]);
  }
  return sum;
}

/// What is lit of all patches, seen along the beam, m².
double lit_section(const PatchMesh& mesh, const Vec3& direction) {
  const SunShadows shadows(mesh, direction);
  const Eigen::VectorXd shares = shadows.lit_shares();
  double sum = 0;
  for (Index i = 0; i < mesh.size(); ++i) {
    sum += mesh.area[i] * shadows.cosine(mesh.normal[i]) * shares[i];
  }
  return sum;
}

/// The plane x, y in [-5, 5] at height 0, n x n patches, and a box.
PatchMesh box_on_plate(const Vec3& low, const Vec3& high, int n_plate, int n_box) {
  PatchMesh mesh;
  add_grid(mesh, Vec3(-5, -5, 0), Vec3(10, 0, 0), Vec3(0, 10, 0), n_plate, n_plate);
  add_box(mesh, low, high, n_box, Facing::outwards);
  return mesh;
}

TEST(SunShadows, OfAMastOnAPlateIsTheClosedForm) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int k = 0; k < 60; ++k) {
    const double width = 0.1 + 0.2 * uniform(random);
    const double depth = 0.1 + 0.2 * uniform(random);
    const double height = 1 + uniform(random);
    const double elevation = 0.5 + uniform(random);
    const double azimuth = 2 * kPi * uniform(random);
    const int n_plate = 1 + k % 13;
    PatchMesh mesh = box_on_plate(Vec3(0.03, -0.02, 0), Vec3(0.03 + width, -0.02 + depth, height),
                                  n_plate, 1 + k % 3);
    const Eigen::Isometry3d motion = random_motion(random);
    transform(mesh, motion);
    const Vec3 up = motion.linear() * Vec3(0, 0, 1);
    const Vec3 direction = sun_direction(azimuth, elevation, up, motion.linear() * Vec3(0, 1, 0));
    // The base, and what its width across the sun's azimuth sweeps along the shadow.
    const double across = width * std::abs(std::cos(azimuth)) + depth * std::abs(std::sin(azimuth));
    const double expected = width * depth + across * height / std::tan(elevation);
    const Eigen::VectorXd shares = SunShadows(mesh, direction).lit_shares();
    EXPECT_NEAR(dark_area(mesh, shares, 0), expected, 1e-9) << k;
  }
}

TEST(SunShadows, OfConvexBodiesHaveTheAreaOfTheirProjection) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int k = 0; k < 40; ++k) {
    PatchMesh mesh;
    const Vec3 size(0.2 + uniform(random), 0.2 + uniform(random), 0.2 + uniform(random));
    add_box(mesh, -size, size, 1 + k % 4, Facing::outwards);
    Eigen::Isometry3d place = random_motion(random);
    place.translation() = Vec3(0, 0, 3);
    transform(mesh, place);
    const Vec3 direction = Vec3(uniform(random) - 0.5, uniform(random) - 0.5, -1).normalized();
    double section = 0;  // of a convex body: half of all faces, seen along the beam
    for (Index i = 0; i < mesh.size(); ++i) {
      section += 0.5 * mesh.area[i] * std::abs(mesh.normal[i].dot(direction));
    }
    EXPECT_NEAR(lit_section(mesh, direction), section, kExact);
    const int n = 1 + k % 9;
    add_grid(mesh, Vec3(-9, -9, 0), Vec3(18, 0, 0), Vec3(0, 18, 0), n, n);
    transform(mesh, random_motion(random));
    // Where the beam went along with the mesh.
    const std::int32_t plate = static_cast<std::int32_t>(mesh.surface_names.size()) - 1;
    const Vec3 up = mesh.normal.back();
    const Vec3 ahead =
        (mesh.corner(mesh.size() - 1, 1) - mesh.corner(mesh.size() - 1, 0)).normalized();
    const Vec3 moved = direction.x() * ahead + direction.y() * up.cross(ahead) + direction.z() * up;
    const Eigen::VectorXd shares = SunShadows(mesh, moved).lit_shares();
    EXPECT_NEAR(dark_area(mesh, shares, plate), section / -direction.z(), kExact) << k;
  }
}

TEST(SunShadows, LetABeamThroughAWindow) {
  // A room 4 x 5 x 3 with a wall of four parts around a window 1 x 1.2; the sun shines in.
  std::mt19937_64 random(3);
  for (const int n : {1, 3, 10}) {
    PatchMesh mesh;
    add_grid(mesh, Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 5, 0), n, n);  // floor
    add_grid(mesh, Vec3(0, 0, 3), Vec3(0, 5, 0), Vec3(4, 0, 0), n, n);  // ceiling
    add_grid(mesh, Vec3(0, 5, 0), Vec3(4, 0, 0), Vec3(0, 0, 3), n, n);
    add_grid(mesh, Vec3(0, 0, 0), Vec3(0, 5, 0), Vec3(0, 0, 3), n, n);
    add_grid(mesh, Vec3(4, 0, 0), Vec3(0, 0, 3), Vec3(0, 5, 0), n, n);
    // Facing +y, into the room: below, above, beside the window [1.5, 2.5] x [0.9, 2.1].
    const auto wall = [&](double x0, double x1, double z0, double z1) {
      add_grid(mesh, Vec3(x0, 0, z0), Vec3(0, 0, z1 - z0), Vec3(x1 - x0, 0, 0), n, n);
    };
    wall(0, 4, 0, 0.9);
    wall(0, 4, 2.1, 3);
    wall(0, 1.5, 0.9, 2.1);
    wall(2.5, 4, 0.9, 2.1);
    const Vec3 beam(0.2, 1, -0.8);
    PatchMesh turned = mesh;
    const Eigen::Isometry3d motion = random_motion(random);
    transform(turned, motion);
    const Eigen::VectorXd shares =
        SunShadows(turned, motion.linear() * beam.normalized()).lit_shares();
    // All of the beam falls on the floor: the window's area times the slope.
    const double lit = 4 * 5 - dark_area(turned, shares, 0);
    EXPECT_NEAR(lit, 1 * 1.2 / 0.8, kExact);
    for (Index i = 0; i < turned.size(); ++i) {
      if (turned.surface[i] != 0) {
        EXPECT_EQ(shares[i], 0) << i;
      }
    }
    // Of points the same: the beam's middle on the floor, and beside it.
    const SunShadows shadows(turned, motion.linear() * beam.normalized());
    const Vec3 up = motion.linear() * Vec3(0, 0, 1);
    const double y = 1.5 / 0.8;
    const auto is_lit = [&](double x) { return shadows.is_lit(motion * Vec3(x, y, 0), up); };
    EXPECT_TRUE(is_lit(2 + 0.2 * y));
    EXPECT_TRUE(is_lit(1.5 + 0.2 * y + 1e-9));
    EXPECT_FALSE(is_lit(1.5 + 0.2 * y - 1e-9));
    EXPECT_FALSE(is_lit(2.5 + 0.2 * y + 1e-9));
  }
}

TEST(SunShadows, KnowFrontsAndBacks) {
  PatchMesh mesh;
  add_grid(mesh, Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), 2, 2);   // up
  add_grid(mesh, Vec3(3, 0, 0), Vec3(0, 1, 0), Vec3(1, 0, 0), 2, 2);   // down: a back to the sun
  add_grid(mesh, Vec3(3, 0, -1), Vec3(1, 0, 0), Vec3(0, 1, 0), 2, 2);  // up, below that back
  add_grid(mesh, Vec3(6, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), 1, 1);   // up, both sides
  test::make_two_sided(mesh, 3);
  add_grid(mesh, Vec3(9, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), 1, 1);  // along the beam
  const Eigen::VectorXd shares = SunShadows(mesh, Vec3(0, 0, -1)).lit_shares();
  for (Index i = 0; i < mesh.size(); ++i) {
    const bool is_sheet = mesh.surface[i] == 3 && mesh.normal[i].z() > 0;
    EXPECT_EQ(shares[i], mesh.surface[i] == 0 || is_sheet ? 1 : 0) << i;
  }
}

TEST(SunShadows, TakeOverlappingBlockersOnce) {
  // Two crossed sheets and one that touches them by an edge: the union of [0, 2] x [0, 1],
  // [1, 3] x [0, 1] and [3, 4] x [0, 1], 4 m² in all.
  PatchMesh mesh;
  add_grid(mesh, Vec3(-1, -1, 0), Vec3(6, 0, 0), Vec3(0, 3, 0), 7, 5);
  add_grid(mesh, Vec3(0, 0, 1), Vec3(2, 0, 1), Vec3(0, 1, 0), 2, 2);
  add_grid(mesh, Vec3(1, 0, 2), Vec3(2, 0, -1), Vec3(0, 1, 0), 3, 1);
  add_grid(mesh, Vec3(3, 0, 1), Vec3(1, 0, 0), Vec3(0, 1, 0), 1, 1);
  const Eigen::VectorXd shares = SunShadows(mesh, Vec3(0, 0, -1)).lit_shares();
  EXPECT_NEAR(dark_area(mesh, shares, 0), 4, kExact);
}

TEST(SunShadows, AreTheSameAtAnyNumberOfThreads) {
  const auto family = test::make_family_scene(test::Family::canyon, 5);
  const PatchMesh mesh = meshing::make_patches(family.scene, {.n_patches = 2000});
  const SunShadows shadows(mesh, Vec3(0.3, 0.2, -0.7).normalized());
  const ThreadLimit one(1);
  const Eigen::VectorXd alone = shadows.lit_shares();
  const ThreadLimit four(4);
  EXPECT_EQ(alone, shadows.lit_shares());
}

/// A ray to the sun against each patch, in double precision.
enum class Beam { free, blocked, grazing };

Beam beam_from(const PatchMesh& mesh, Index from, const Vec3& x, const Vec3& up) {
  constexpr double kGrazing = 1e-7;  // m; scenes have some 1 m
  Beam result = Beam::free;
  for (Index i = 0; i < mesh.size(); ++i) {
    const Vec3& normal = mesh.normal[i];
    const double cosine = normal.dot(up);
    bool is_in_plane = true;
    for (int k = 0; k < mesh.n_corners(from); ++k) {
      is_in_plane &= std::abs(normal.dot(mesh.corner(from, k) - mesh.centroid[i])) < 1e-9;
    }
    if (is_in_plane || std::abs(cosine) < 1e-9) continue;
    const double way = normal.dot(mesh.centroid[i] - x) / cosine;
    const double rise = way * mesh.normal[from].dot(up);
    if (rise < -kGrazing) continue;
    double inside = 1e9;  // least distance within an edge
    for (int k = 0; k < mesh.n_corners(i); ++k) {
      const Vec3& a = mesh.corner(i, k);
      const Vec3& b = mesh.corner(i, (k + 1) % mesh.n_corners(i));
      inside = std::min(inside, normal.dot((b - a).normalized().cross(x + way * up - a)));
    }
    if (inside < -kGrazing) continue;
    if (inside < kGrazing || rise < kGrazing) {
      result = Beam::grazing;
    } else {
      return Beam::blocked;
    }
  }
  return result;
}

class SunOnFamilies : public testing::TestWithParam<test::Family> {};

TEST_P(SunOnFamilies, IsWhatRaysFind) {
  constexpr int kPoints = 200;
  for (const std::uint64_t seed : {1, 2}) {
    const test::FamilyScene family = test::vary(test::make_family_scene(GetParam(), seed),
                                                {.is_turned = seed == 2, .seed = seed});
    const PatchMesh mesh = meshing::make_patches(family.scene, {.n_patches = 150});
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(0, 1);
    const Vec3 direction = test::random_unit(random);
    const SunShadows shadows(mesh, direction);
    const Eigen::VectorXd shares = shadows.lit_shares();
    const Index step = std::max<Index>(1, mesh.size() / 40);
    for (Index i = 0; i < mesh.size(); i += step) {
      const bool is_turned_away = shadows.cosine(mesh.normal[i]) == 0;
      if (is_turned_away) {
        EXPECT_EQ(shares[i], 0);
        continue;
      }
      int n_lit = 0;
      int n_grazing = 0;
      for (int k = 0; k < kPoints; ++k) {
        // Evenly in the patch's two triangles.
        double u = uniform(random);
        double v = uniform(random);
        const Vec3& a = mesh.corner(i, 0);
        Vec3 b = mesh.corner(i, 1);
        Vec3 c = mesh.corner(i, 2);
        if (mesh.n_corners(i) == 4) {
          const Vec3 half = mesh.corner(i, 3) - a;
          const double first = 0.5 * (b - a).cross(c - a).norm();
          if (uniform(random) * mesh.area[i] > first) {
            b = c;
            c = a + half;
          }
        }
        if (u + v > 1) {
          u = 1 - u;
          v = 1 - v;
        }
        const Vec3 x = a + u * (b - a) + v * (c - a);
        const Beam beam = beam_from(mesh, i, x, -direction);
        n_grazing += beam == Beam::grazing ? 1 : 0;
        n_lit += beam == Beam::free ? 1 : 0;
        if (beam == Beam::grazing) continue;
        ASSERT_EQ(shadows.is_lit(x, mesh.normal[i]), beam == Beam::free) << "patch " << i;
      }
      // 4.5 standard errors of the binomial, and room for its skewness and for grazing points.
      const double sigma = std::sqrt(shares[i] * (1 - shares[i]) / kPoints);
      EXPECT_NEAR(static_cast<double>(n_lit) / kPoints, shares[i],
                  4.5 * sigma + (4.0 + n_grazing) / kPoints)
          << family.name << ", patch " << i;
      if (n_grazing == 0 && (shares[i] == 0 || shares[i] == 1)) {
        EXPECT_EQ(n_lit, shares[i] == 1 ? kPoints : 0);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, SunOnFamilies, testing::ValuesIn(test::kFamilies));

TEST(SunShadows, KeepTheirPowerHoweverTheSceneIsTurnedAndDivided) {
  for (const test::Family family : test::kFamilies) {
    const test::FamilyScene scene = test::make_family_scene(family, 7);
    const Vec3 direction = Vec3(0.31, -0.22, -0.9).normalized();
    const double section =
        lit_section(meshing::make_patches(scene.scene, {.n_patches = 20}), direction);
    // Other patches; six digits move corners by 5e-7 m along outlines of some 10 m each.
    const test::FamilyScene rounded = test::vary(scene, {.digits = test::Digits::six});
    const PatchMesh finer = meshing::make_patches(scene.scene, {.n_patches = 400});
    EXPECT_NEAR(lit_section(finer, direction), section, 1e-9) << scene.name;
    const double outlines = 10.0 * static_cast<double>(scene.scene.n_polygons());
    EXPECT_NEAR(lit_section(meshing::make_patches(rounded.scene, {}), direction), section,
                1e-6 * outlines)
        << scene.name;
  }
}

}  // namespace
}  // namespace radiosity

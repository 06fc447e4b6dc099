// Luminaires of some extent: luminous openings against closed forms of areas and lines, near and
// far.
#include "radiosity/visibility/opening_light.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "radiosity/base/parallel.h"
#include "radiosity/polygon/exchange_area.h"
#include "radiosity/polygon/point_to_polygon.h"
#include "radiosity/visibility/luminaire_light.h"
#include "tests/support/shapes.h"

namespace radiosity {
namespace {

using test::add_grid;

constexpr int kAngles = 301;
/// What linear interpolation between so many angles takes of a cosine, at most.
constexpr double kOfWeb = (kPi / (kAngles - 1)) * (kPi / (kAngles - 1)) / 8;
/// What half a luminaire's share lies within where its error says so, and rounding.
constexpr double kSlack = 1e-12;

/// Φ / π cosγ downwards.
PhotometricWeb lambertian(double flux) {
  PhotometricWeb web{PhotometricWeb::Type::c, {}, {0}, Eigen::MatrixXd(kAngles, 1)};
  for (int k = 0; k < kAngles; ++k) {
    web.polar.push_back(kPi / 2 * k / (kAngles - 1));
    web.intensity(k, 0) = flux / kPi * std::max(0., std::cos(web.polar.back()));
  }
  return web;
}

/// I sinγ all around: what a diffuse tube along the axis has.
PhotometricWeb diffuse_tube(double candela) {
  PhotometricWeb web{PhotometricWeb::Type::c, {}, {0}, Eigen::MatrixXd(kAngles, 1)};
  for (int k = 0; k < kAngles; ++k) {
    web.polar.push_back(kPi * k / (kAngles - 1));
    web.intensity(k, 0) = candela * std::max(0., std::sin(web.polar.back()));
  }
  return web;
}

/// A luminaire of an opening, moved with all around it.
struct Case {
  Scene scene;
  Eigen::Isometry3d motion;

  Case(const PhotometricWeb& web, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    motion = Eigen::Isometry3d::Identity();
    if (seed > 0) {
      motion = Eigen::Translation3d(3 * test::random_unit(random)) *
               Eigen::AngleAxisd(1.0 + static_cast<double>(seed), test::random_unit(random));
    }
    scene.bands = {.kind = Bands::Kind::grey, .wavelengths = {}};
    scene.photometries.emplace_back();
    scene.photometries[0].web = web;
    scene.luminaires.emplace_back();
    scene.luminaires[0].position = motion.translation();
    scene.luminaires[0].axes = motion.linear();
    scene.luminaires[0].watts_per_lumen = Eigen::VectorXd::Ones(1);
  }

  [[nodiscard]] PatchMesh moved(PatchMesh mesh) const {
    for (Vec3& vertex : mesh.vertices) vertex = motion * vertex;
    for (Vec3& centroid : mesh.centroid) centroid = motion * centroid;
    for (Vec3& normal : mesh.normal) normal = motion.linear() * normal;
    return mesh;
  }

  /// The luminaire is in the origin of x.
  void expect_lux(const PatchMesh& mesh, const Vec3& x, const Vec3& normal, double expected,
                  double off) const {
    const LuminaireLight light(scene, mesh);
    EXPECT_TRUE(light.cut_openings().empty());
    Eigen::VectorXd found = Eigen::VectorXd::Zero(1);
    const double told = light.add(motion * x, motion.linear() * normal, found);
    EXPECT_NEAR(found[0], expected, told + off * expected + kSlack) << x.transpose();
    EXPECT_LT(told, 1e-4 * expected) << x.transpose();
  }
};

PatchMesh far_away() {
  PatchMesh mesh;
  add_grid(mesh, Vec3(-1, -1, -500), Vec3(2, 0, 0), Vec3(0, 2, 0), 1, 1);
  return mesh;
}

constexpr double kDiameters[] = {0.2, 0.5, 1, 2, 5, 20};

TEST(OpeningLight, OfADiscIsThatOfItsFormFactor) {
  // Element parallel to a disc of radius r, a off its axis at the height h: with H = h/a, R = r/a,
  // Z = 1 + H² + R²: F = (1 - (Z - 2R²) / sqrt(Z² - 4R²)) / 2 (Howell B-13). Its polygons are off
  // by 4e-6 of their second moments.
  for (const std::uint64_t seed : {0, 1, 2}) {
    for (const double radius : {0.3, 0.05}) {
      Case room(lambertian(1000), seed);
      room.scene.photometries[0].along_c0 = 2 * radius;
      room.scene.photometries[0].along_c90 = 2 * radius;
      room.scene.photometries[0].is_round = true;
      const double exitance = 1000 / (kPi * radius * radius);
      for (const double diameters : kDiameters) {
        const double h = 2 * radius * diameters;
        for (const double a : {0.01 * radius, 0.7 * radius, 2 * radius, 1.5 * h}) {
          const double z = 1 + square(h / a) + square(radius / a);
          const double factor =
              0.5 * (1 - (z - 2 * square(radius / a)) / std::sqrt(z * z - 4 * square(radius / a)));
          // The formula cancels by (r/a)² of its terms.
          const double rounding = 1e-15 * z / factor;
          room.expect_lux(room.moved(far_away()), Vec3(0.6 * a, -0.8 * a, -h), Vec3::UnitZ(),
                          exitance * factor, kOfWeb + 4e-6 + rounding);
        }
      }
    }
  }
}

TEST(OpeningLight, OfARectangleIsThatOfItsFormFactor) {
  for (const std::uint64_t seed : {0, 3, 4}) {
    for (const double length : {1.2, 0.3}) {
      Case room(lambertian(1000), seed);
      room.scene.photometries[0].along_c0 = length;
      room.scene.photometries[0].along_c90 = 0.6;
      const std::vector<Vec3> opening{{-length / 2, -0.3, 0},
                                      {-length / 2, 0.3, 0},
                                      {length / 2, 0.3, 0},
                                      {length / 2, -0.3, 0}};
      const double exitance = 1000 / (0.6 * length);
      for (const double diameters : kDiameters) {
        const double h = length * diameters;
        for (const Vec3& x : {Vec3(0, 0, -h), Vec3(0.55 * length, 0.1, -h), Vec3(h, 2 * h, -h)}) {
          for (const Vec3& normal : {Vec3(0, 0, 1), Vec3(-0.6, 0, 0.8), Vec3(0, -1, 0)}) {
            const double factor = point_to_polygon(x, normal, opening);
            if (factor < 1e-12) continue;
            room.expect_lux(room.moved(far_away()), x, normal, exitance * factor, 3 * kOfWeb);
          }
        }
      }
    }
  }
}

TEST(OpeningLight, OfATubeIsThatOfItsLine) {
  // A diffuse line of the intensity I across it, of length L: facing it, a distance d away,
  // E = I / (2 L d) [φ + sinφ cosφ] between the angles of its ends. The tube's width w is off by
  // (w/d)².
  constexpr double kWidth = 1e-3;
  for (const std::uint64_t seed : {0, 5, 6}) {
    for (const double length : {1.5, 0.6}) {
      Case room(diffuse_tube(100), seed);
      room.scene.photometries[0].along_c0 = kWidth;
      room.scene.photometries[0].along_c90 = kWidth;
      room.scene.photometries[0].height = length;
      room.scene.photometries[0].is_round = true;
      for (const double lengths : kDiameters) {
        const double d = lengths * length;
        for (const double z : {0., 0.4 * length, -1.5 * length}) {
          const double low = std::atan2(-length / 2 - z, d);
          const double high = std::atan2(length / 2 - z, d);
          const auto part = [](double phi) { return phi + std::sin(phi) * std::cos(phi); };
          const double expected = 100 / (2 * length * d) * (part(high) - part(low));
          const Vec3 way(0.6, 0.8, 0);
          room.expect_lux(room.moved(far_away()), d * way + Vec3(0, 0, z), -way, expected,
                          kOfWeb + square(kWidth / d));
        }
      }
    }
  }
}

// Half of the opening behind an edge: what is left of the rectangle, exactly.
TEST(OpeningLight, HasExactPenumbras) {
  for (const std::uint64_t seed : {0, 7}) {
    Case room(lambertian(500), seed);
    room.scene.photometries[0].along_c0 = 1;
    room.scene.photometries[0].along_c90 = 0.5;
    // From (0, 0, -2) the screen at half way hides what lies beyond x = 2 edge.
    for (const double edge : {-0.2, 0.03, 0.2, 0.2499}) {
      PatchMesh mesh;
      add_grid(mesh, Vec3(edge, -1, -1), Vec3(3, 0, 0), Vec3(0, 2, 0), 3, 2);
      const double x = 2 * edge;
      const std::vector<Vec3> seen{{-0.5, -0.25, 0}, {-0.5, 0.25, 0}, {x, 0.25, 0}, {x, -0.25, 0}};
      const double factor = point_to_polygon(Vec3(0, 0, -2), Vec3(0, 0, 1), seen);
      room.expect_lux(room.moved(mesh), Vec3(0, 0, -2), Vec3(0, 0, 1), 1000 * factor, 3 * kOfWeb);
    }
  }
}

TEST(OpeningLight, OfPatchesIsThatOfTheirExchangeArea) {
  for (const std::uint64_t seed : {0, 8}) {
    Case room(lambertian(1000), seed);
    room.scene.photometries[0].along_c0 = 0.9;
    room.scene.photometries[0].along_c90 = 0.6;
    const std::vector<Vec3> opening{
        {-0.45, -0.3, 0}, {-0.45, 0.3, 0}, {0.45, 0.3, 0}, {0.45, -0.3, 0}};
    for (const double h : {0.2, 0.5, 1., 3., 18.}) {
      PatchMesh mesh;
      add_grid(mesh, Vec3(-0.2, -0.9, -h), Vec3(0.7, 0.1, 0), Vec3(0, 1, 0), 1, 1);
      add_grid(mesh, Vec3(1, 0.3, -h), Vec3(0, 0, 0.8 * h), Vec3(0, 0.4, 0), 1, 1);
      const PatchMesh moved = room.moved(mesh);
      const IncidentIrradiance found = LuminaireLight(room.scene, moved).irradiance();
      for (Index i = 0; i < mesh.size(); ++i) {
        std::vector<Vec3> patch;
        for (int k = 0; k < mesh.n_corners(i); ++k) patch.push_back(mesh.corner(i, k));
        const double expected = 1000 / 0.54 * exchange_area(patch, opening) / mesh.area[i];
        EXPECT_NEAR(found.irradiance(i, 0), expected,
                    found.error[i] + 3 * kOfWeb * expected + kSlack);
        EXPECT_LT(found.error[i], 2e-3 * expected + 5e-4 * 1000 / (mesh.area[0] + mesh.area[1]))
            << h;
      }
    }
  }
}

// On a ceiling of many patches, with a box below: the flux of the room is the luminaire's.
TEST(OpeningLight, KeepsItsFluxInARoom) {
  for (const bool is_round : {false, true}) {
    Case room(lambertian(1000), 9);
    room.scene.photometries[0].along_c0 = 0.6;
    room.scene.photometries[0].along_c90 = 0.6;
    room.scene.photometries[0].is_round = is_round;
    PatchMesh mesh;
    test::add_box(mesh, Vec3(-1.5, -1, -2.5), Vec3(1.2, 1.1, 0), 5, test::Facing::inwards);
    test::add_box(mesh, Vec3(0.1, -0.2, -2.5), Vec3(0.8, 0.4, -0.7), 2, test::Facing::outwards);
    mesh = room.moved(mesh);
    const LuminaireLight light(room.scene, mesh);
    EXPECT_TRUE(light.cut_openings().empty());
    const IncidentIrradiance found = light.irradiance();
    double flux = 0;
    double error = 0;
    for (Index i = 0; i < mesh.size(); ++i) {
      flux += mesh.area[i] * found.irradiance(i, 0);
      error += mesh.area[i] * found.error[i];
    }
    EXPECT_NEAR(flux, 1000, error + 1000 * kOfWeb);
    // As asked of each patch, but where edges of the box throw shadows.
    EXPECT_LT(error, 5e-3 * 1000);
    // However luminaires are dimmed.
    Scene dimmed = room.scene;
    dimmed.luminaires[0].dimming = 0.3;
    const Eigen::MatrixXd less = LuminaireLight(dimmed, mesh).irradiance().irradiance;
    EXPECT_LT((less - 0.3 * found.irradiance).norm(), 1e-12 * found.irradiance.norm());
    const ThreadLimit one(1);
    EXPECT_EQ(LuminaireLight(room.scene, mesh).irradiance().irradiance, found.irradiance);
  }
}

TEST(OpeningLight, ThatASurfaceCutsCountsAsAPoint) {
  Case room(lambertian(100), 0);
  room.scene.photometries[0].along_c0 = 1;
  room.scene.photometries[0].along_c90 = 0.2;
  const auto n_cut = [&](double wall) {
    PatchMesh mesh;
    add_grid(mesh, Vec3(wall, -1, -2), Vec3(0, 0, 4), Vec3(0, 2, 0), 2, 2);
    return LuminaireLight(room.scene, mesh).cut_openings().size();
  };
  EXPECT_EQ(n_cut(0.4), 1);
  EXPECT_EQ(n_cut(-0.01), 1);
  EXPECT_EQ(n_cut(0.5), 0);  // it touches the wall
  EXPECT_EQ(n_cut(0.6), 0);
  // What light the point has is all there.
  PatchMesh mesh;
  add_grid(mesh, Vec3(0.4, -1, -2), Vec3(0, 0, 4), Vec3(0, 2, 0), 2, 2);
  Eigen::VectorXd found = Eigen::VectorXd::Zero(1);
  EXPECT_EQ(LuminaireLight(room.scene, mesh).add({0, 0, -1}, {0, 0, 1}, found), 0);
  EXPECT_NEAR(found[0], 100 / kPi, 1e-12);
}

}  // namespace
}  // namespace radiosity

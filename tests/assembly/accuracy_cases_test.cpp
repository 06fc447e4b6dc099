/// Scenes with known answers that are hard to get right (data/accuracy/README.md): each at several
/// sizes of patches, turned out of the axes, and turned and written with 6 digits.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <optional>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "io/base/rounding.h"
#include "io/scene/scene_file.h"
#include "meshing/adaptive/adaptive.h"
#include "meshing/inspect/inspect.h"
#include "meshing/patches/patches.h"
#include "radiosity/assembly/make_dense_transport.h"
#include "radiosity/assembly/transport_options.h"
#include "radiosity/exchange/point_factors.h"
#include "radiosity/operator/surface_factors.h"
#include "radiosity/operator/transport.h"
#include "radiosity/polygon/exchange_area.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/radiometry.h"
#include "radiosity/solve/solution.h"
#include "radiosity/solve/solve.h"

namespace {

using namespace radiosity;

constexpr double kCaseTolerance = 1e-3;
/// Of what is proved.
constexpr double kCaseRounding = 1e-9;

/// How the scene of the file is changed before it is used.
enum class Digits { as_given, all, six };

struct Variation {
  Digits digits;
  std::optional<long> n_patches;  ///< absent: each polygon is one

  [[nodiscard]] std::string name() const {
    const std::string size = n_patches ? std::to_string(*n_patches) : "AsIs";
    switch (digits) {
      case Digits::as_given:
        return "AsGiven" + size;
      case Digits::all:
        return "Turned" + size;
      case Digits::six:
        break;
    }
    return "TurnedWithSixDigits" + size;
  }
};

void PrintTo(const Variation& variation, std::ostream* stream) { *stream << variation.name(); }

std::string variation_name(const testing::TestParamInfo<Variation>& info) {
  return info.param.name();
}

Scene read_case(const std::string& name) {
  return io::read_scene(std::string(RADIOSITY_TEST_DATA "/accuracy/") + name + ".json");
}

void turn(Scene& scene) {
  const Eigen::Matrix3d rotation =
      (Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()) * Eigen::AngleAxisd(0.3, Vec3::UnitX()))
          .toRotationMatrix();
  for (Vec3& vertex : scene.vertices) vertex = rotation * vertex;
}

double with_six_digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return std::strtod(text, nullptr);
}

Scene read_case(const std::string& name, Digits digits) {
  Scene scene = read_case(name);
  if (digits == Digits::as_given) return scene;
  turn(scene);
  if (digits == Digits::all) return scene;
  for (Vec3& vertex : scene.vertices) {
    for (double& x : vertex) x = with_six_digits(x);
  }
  scene.precision = io::found_rounding(scene.vertices).precision;
  EXPECT_GT(scene.precision, 0);
  return scene;
}

/// A scene with its form factors.
struct Case {
  Scene scene;
  PatchMesh mesh;
  std::unique_ptr<Transport> transport;

  [[nodiscard]] Index surface(const std::string& name) const {
    const auto& names = mesh.surface_names;
    const auto found = std::find(names.begin(), names.end(), name);
    EXPECT_NE(found, names.end()) << name;
    return found - names.begin();
  }
  [[nodiscard]] Solution light() const {
    return solve(*transport, exitance(scene, mesh), reflectance(scene, mesh), {});
  }
  /// Area-weighted mean over a surface.
  [[nodiscard]] double mean(const Eigen::VectorXd& values, Index of) const {
    double sum = 0;
    double area = 0;
    for (Index i = 0; i < mesh.size(); ++i) {
      if (mesh.surface[i] != of) continue;
      sum += mesh.area[i] * values[i];
      area += mesh.area[i];
    }
    return sum / area;
  }
};

Case make_case(Scene scene, const meshing::PatchOptions& options) {
  Case result{.scene = std::move(scene), .mesh = {}, .transport = nullptr};
  result.mesh = meshing::make_patches(result.scene, options);
  TransportOptions transport{.tolerance = kCaseTolerance};
  if (result.scene.closed) {
    transport.closed = *result.scene.closed ? Closed::yes : Closed::no;
  }
  result.transport = make_dense_transport(result.mesh, Visibility(result.mesh), transport);
  return result;
}

Case make_case(const std::string& name, const Variation& variation) {
  return make_case(read_case(name, variation.digits), {.n_patches = variation.n_patches});
}

/// A surface factor that proofs make exact, but for the digits that coordinates have lost.
double exact_to(const Case& made) { return std::max(kCaseRounding, 20 * made.scene.precision); }

class AccuracyCase : public testing::TestWithParam<Variation> {};
INSTANTIATE_TEST_SUITE_P(AsIs, AccuracyCase,
                         testing::Values(Variation{Digits::as_given, {}},
                                         Variation{Digits::all, {}}, Variation{Digits::six, {}}),
                         variation_name);
INSTANTIATE_TEST_SUITE_P(Divided, AccuracyCase,
                         testing::Values(Variation{Digits::as_given, 300},
                                         Variation{Digits::as_given, 1000},
                                         Variation{Digits::all, 300}, Variation{Digits::six, 300}),
                         variation_name);

TEST_P(AccuracyCase, StackedPlatesHideEachOther) {
  const Case plates = make_case("stacked-plates", GetParam());
  const Eigen::MatrixXd F = surface_form_factors(plates.mesh, *plates.transport);
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(4, 4);
  expected(0, 1) = expected(1, 0) = 0.19982489569838748;
  EXPECT_LE((F - expected).cwiseAbs().maxCoeff(), 0.1 * kCaseTolerance) << F;
  EXPECT_LE(std::max({F(0, 2), F(0, 3), F(1, 2), F(1, 3), F(2, 3)}), exact_to(plates)) << F;
}

TEST_P(AccuracyCase, ThreePlatesAreSeparatedByTheMiddleOne) {
  const Case plates = make_case("three-plates", GetParam());
  const Eigen::MatrixXd F = surface_form_factors(plates.mesh, *plates.transport);
  constexpr double kNeighbour = 0.415253268274;
  EXPECT_NEAR(F(0, 1), kNeighbour, 0.1 * kCaseTolerance);
  EXPECT_NEAR(F(2, 1), kNeighbour, 0.1 * kCaseTolerance);
  EXPECT_NEAR(F(1, 0), kNeighbour / 2, 0.1 * kCaseTolerance);  // of both sides
  EXPECT_NEAR(F(1, 2), kNeighbour / 2, 0.1 * kCaseTolerance);
  EXPECT_LE(F(0, 2), exact_to(plates));
}

TEST_P(AccuracyCase, ALampBelowTheCeilingLightsTheFloor) {
  const Case room = make_case("lamp-below-ceiling", GetParam());
  const Index light = room.surface("light");
  const Index floor = room.surface("floor");
  const Eigen::MatrixXd F = surface_form_factors(room.mesh, *room.transport);
  // Nothing is between them.
  const auto polygon = [&](Index i) {
    std::vector<Vec3> points;
    for (const auto v : room.scene.polygon(i)) points.push_back(room.scene.vertices[v]);
    return points;
  };
  const double area = 0.47 * 0.38;
  const double expected = exchange_area(polygon(2), polygon(0), 1e-8) / area;
  EXPECT_NEAR(F(light, floor), expected, kCaseTolerance * expected);
  // Four digits are given, and what the ceiling returns depends on the patches a little.
  const Eigen::VectorXd irradiance = room.light().irradiance;
  EXPECT_NEAR(room.mean(irradiance, floor), 0.0339, 0.01 * 0.0339);
}

TEST_P(AccuracyCase, AnAdiabaticShieldSeparates) {
  const Case box = make_case("shield-adiabatic", GetParam());
  const Solution solution = box.light();
  const Eigen::VectorXd net = solution.radiosity - solution.irradiance;
  const double emitted = box.mean(solution.exitance, box.surface("hot"));
  EXPECT_NEAR(box.mean(net, box.surface("hot")), 0, 1e-3 * emitted);
  EXPECT_NEAR(box.mean(net, box.surface("cold")), 0, 1e-3 * emitted);
  EXPECT_EQ(box.transport->report().open_rows, 0);
}

TEST_P(AccuracyCase, TheCoveredEndOfABoardSeesNothing) {
  const Case solids = make_case("touching-solids", GetParam());
  const Eigen::MatrixXd F = surface_form_factors(solids.mesh, *solids.transport);
  const Index end = solids.surface("board0");
  for (Index other = 0; other < F.cols(); ++other) {
    const std::string& name = solids.mesh.surface_names[other];
    if (name != "left1") {
      EXPECT_LE(F(end, other), exact_to(solids)) << name;
      EXPECT_LE(F(other, end), exact_to(solids)) << name;
    }
  }
  const double covered = 0.03 / 1.75;
  EXPECT_NEAR(F.row(solids.surface("left1")).sum(), 1 - covered, 5 * kCaseTolerance);
  // Neither is an opening.
  EXPECT_TRUE(solids.transport->report().closed);
  EXPECT_EQ(solids.transport->report().open_rows, 0);
}

/// The lamp is a sheet whose back takes what it meets.
TEST_P(AccuracyCase, NothingEscapesFromARoomWithAHungLamp) {
  const Case room = make_case("error-bars-hung-lamp", GetParam());
  const EnergyBalance energy = room.light().energy;
  EXPECT_NEAR(energy.escaped.sum(), 0, 1e-6 * energy.emitted.sum());
  EXPECT_EQ(room.transport->report().open_rows, 0);
}

TEST(AccuracyCases, AHungLampLightsTheFloorWhateverThePatches) {
  std::vector<double> means;
  for (const double max_edge : {0.25, 0.125, 0.0625}) {
    const Case room = make_case(read_case("error-bars-hung-lamp"), {.max_edge = max_edge});
    means.push_back(room.mean(room.light().radiosity, room.surface("w4")));
  }
  // What is left is the size of the patches, first order at worst: the steps get smaller.
  EXPECT_NEAR(means[1], means[2], 0.01 * means[2]);
  EXPECT_NEAR(means[0], means[2], 0.02 * means[2]);
}

TEST(AccuracyCases, SixDigitsGiveTheSameFactors) {
  for (const std::optional<long> n_patches : {std::optional<long>(), std::optional<long>(300)}) {
    const Case all = make_case("turned-boxes-17-digits", {Digits::as_given, n_patches});
    const Case six = make_case("turned-boxes-6-digits", {Digits::as_given, n_patches});
    ASSERT_EQ(all.mesh.size(), six.mesh.size());
    const Eigen::MatrixXd F = surface_form_factors(all.mesh, *all.transport);
    const Eigen::MatrixXd G = surface_form_factors(six.mesh, *six.transport);
    EXPECT_LE((F - G).cwiseAbs().maxCoeff(), 1e-5);
    EXPECT_EQ(all.transport->report().open_rows, 0);
    EXPECT_EQ(six.transport->report().open_rows, 0);
    const auto n_undecided = static_cast<double>(all.transport->report().undecided);
    EXPECT_LE(static_cast<double>(six.transport->report().undecided), 1.05 * n_undecided);
  }
}

TEST_P(AccuracyCase, NothingIsUndecidedAcrossAPartyWall) {
  const Case one = make_case("one-room", GetParam());
  Variation twice = GetParam();
  if (twice.n_patches) twice.n_patches = 2 * *twice.n_patches;
  const Case two = make_case("two-rooms-back-to-back", twice);
  EXPECT_EQ(one.transport->report().undecided, 0);
  // Rounded, segments along the walls may pass the edges where they meet on either side.
  const double share = GetParam().digits == Digits::six ? 1e-3 : 0;
  const AssemblyReport& report = two.transport->report();
  EXPECT_LE(static_cast<double>(report.undecided), share * static_cast<double>(report.facing));
  EXPECT_LE(static_cast<double>(report.partial), share * static_cast<double>(report.facing));
  EXPECT_EQ(two.transport->report().open_rows, 0);
}

TEST(AccuracyCases, OverlappingPanelsAreNamed) {
  const std::optional<std::string> finding =
      meshing::overlap_finding(read_case("overlapping-panels"));
  ASSERT_TRUE(finding);
  EXPECT_NE(finding->find("'panels'"), std::string::npos) << *finding;
  EXPECT_NE(finding->find("'walls'"), std::string::npos) << *finding;
  for (const char* fine : {"two-rooms-back-to-back", "touching-solids", "turned-boxes-6-digits"}) {
    EXPECT_FALSE(meshing::overlap_finding(read_case(fine))) << fine;
  }
}

TEST(AccuracyCases, APanelAboveAGroundOfTwoThousandKilometres) {
  for (const std::optional<long> n_patches : {std::optional<long>(), std::optional<long>(300)}) {
    const Case yard = make_case("ground-1e+06", {Digits::as_given, n_patches});
    const Eigen::MatrixXd F = surface_form_factors(yard.mesh, *yard.transport);
    const Eigen::MatrixXd error = surface_form_factor_errors(yard.mesh, *yard.transport);
    const Index panel = yard.surface("panel");
    const Index ground = yard.surface("ground");
    constexpr double kExpected = 0.792373;
    EXPECT_NEAR(F(panel, ground), kExpected, kCaseTolerance + 3 * error(panel, ground));
    EXPECT_LE(yard.transport->report().row_sums.maxCoeff(), 1 + kCaseTolerance);
  }
}

TEST(AccuracyCases, CavityOfSidesThreeFourFive) {
  const Case cavity = make_case("cavity345", {Digits::as_given, {}});
  const Eigen::VectorXd B = cavity.light().radiosity;
  // 2.5e-4 of what leaves each side goes out at the ends, 20 W per metre. That much less reaches
  // side 1, whose radiosity falls by (1 - ε) / ε of it per area, 7.4 W/m², and the others' by as
  // much and what their own 20 W would have brought.
  constexpr double kOpenEnds = 2e-3;
  EXPECT_NEAR(B[0], 4584.300, kOpenEnds * 4584.300);
  EXPECT_NEAR(B[1], 8220.664, kOpenEnds * 8220.664);
  EXPECT_NEAR(B[2], 7038.846, kOpenEnds * 7038.846);
}

TEST(AccuracyCases, ConcentricCylinders) {
  const Case cylinders = make_case("concentric", {Digits::as_given, {}});
  const Solution solution = cylinders.light();
  const Eigen::VectorXd net = solution.radiosity - solution.irradiance;
  EXPECT_NEAR(cylinders.mean(net, cylinders.surface("inner")), 9750.47, kCaseTolerance * 9750.47);
  EXPECT_NEAR(cylinders.mean(net, cylinders.surface("outer")), -4875.23, kCaseTolerance * 4875.23);
}

TEST(AccuracyCases, Rods) {
  const Case rods = make_case("rods", {Digits::as_given, {}});
  const Eigen::MatrixXd F = surface_form_factors(rods.mesh, *rods.transport);
  EXPECT_NEAR(F(rods.surface("rod0"), rods.surface("rod1")), 0.15769, 0.00018);
}

/// Up the middle one of infinite rows, 2 m wide, tilted by 30 degrees, 4 m apart: the row in front
/// hides what is below its upper edge. F_sky = (1 - sin) / 2 with the angle from the normal.
TEST(AccuracyCases, SkyFromRowsOfSolarPanels) {
  const PatchMesh mesh = meshing::make_patches(read_case("pvrows"));
  const Vec3 along(std::sqrt(3) / 2, 0, 0.5);
  const Vec3 normal(-0.5, 0, std::sqrt(3) / 2);
  const std::array<double, 5> places = {.001, .25, .5, .75, .999};  // shares of the width
  const std::array<double, 5> expected = {.79561, .85034, .88822, .91447, .93295};
  for (int k = 0; k < 5; ++k) {
    const Vec3 point = Vec3(4, 0, 0.5) + 2 * places[k] * along;
    EXPECT_NEAR(point_factors(mesh, point, normal).sky, expected[k], 1e-5) << k;
  }
}

TEST(AccuracyCases, RoundingIsNoGap) {
  for (const meshing::Finding& finding : meshing::inspect(read_case("gap-rounding")).findings) {
    EXPECT_NE(finding.kind, meshing::Finding::Kind::gap) << finding.message;
  }
}

}  // namespace

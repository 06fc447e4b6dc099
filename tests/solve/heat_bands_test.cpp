// Heat in grey bands, in closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "radiosity/scene/black_body.h"
#include "radiosity/scene/radiometry.h"
#include "radiosity/solve/solve.h"
#include "radiosity/solve/surface_flux.h"
#include "tests/support/matrix_transport.h"
#include "tests/support/shapes.h"

namespace {

using namespace radiosity;

/// Two plates of 1 m² that see nothing but each other, as if they had no end.
struct Plates {
  Plates() {
    test::add_grid(mesh, Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), 1, 1);
    test::add_grid(mesh, Vec3(0, 0, 1), Vec3(0, 1, 0), Vec3(1, 0, 0), 1, 1);
    scene.surfaces = {{"hot", 0, false}, {"cold", 1, false}};
    mesh.surface_names = {"hot", "cold"};
  }
  void set_materials(const Eigen::VectorXd& emissivity1, double temperature1,
                     const Eigen::VectorXd& emissivity2, double temperature2) {
    const auto material = [](const Eigen::VectorXd& emissivity, double temperature) {
      return Material{"",
                      (1 - emissivity.array()).matrix(),
                      {Emission::Kind::temperature, Eigen::VectorXd::Constant(1, temperature)}};
    };
    scene.materials = {material(emissivity1, temperature1), material(emissivity2, temperature2)};
  }
  [[nodiscard]] std::vector<SurfaceFlux> fluxes(const Eigen::MatrixXd& incident = {}) const {
    const test::DenseTestTransport transport =
        test::close((Eigen::Matrix2d() << 0, 1, 1, 0).finished());
    const Eigen::MatrixXd emitted = exitance(scene, mesh);
    const Eigen::MatrixXd reflected = reflectance(scene, mesh);
    return surface_fluxes(
        mesh, solve(transport, emitted, reflected, {.tolerance = 1e-13, .incident = incident}));
  }
  PatchMesh mesh;
  Scene scene;
};

/// σ T⁴ between two wavelengths, µm.
double black(double temperature, double from, double to) {
  return kStefanBoltzmann * std::pow(temperature, 4) *
         (black_body_fraction(to * temperature) - black_body_fraction(from * temperature));
}

// q = Σ_b (E_b(T1) - E_b(T2)) / (1/ε1b + 1/ε2b - 1).
TEST(HeatBands, OfTwoPlatesAreTheClosedForm) {
  for (const double hot : {400., 900., 2500.}) {
    Plates plates;
    plates.scene.bands = {.kind = Bands::Kind::thermal, .wavelengths = {}, .edges = {4}};
    plates.set_materials(Eigen::Vector2d(0.8, 0.3), hot, Eigen::Vector2d(0.2, 0.9), 300);
    const double below = (black(hot, 0, 4) - black(300, 0, 4)) / (1 / 0.8 + 1 / 0.2 - 1);
    const double above = (black(hot, 4, 1e9) - black(300, 4, 1e9)) / (1 / 0.3 + 1 / 0.9 - 1);
    const std::vector<SurfaceFlux> fluxes = plates.fluxes();
    // The solver's bound, of all that is emitted.
    const double allowed = 1e-12 * kStefanBoltzmann * std::pow(hot, 4);
    EXPECT_NEAR(fluxes[0].band_heat[0], below, allowed);
    EXPECT_NEAR(fluxes[0].band_heat[1], above, allowed);
    EXPECT_NEAR(fluxes[0].heat, below + above, allowed);
    EXPECT_NEAR(fluxes[1].heat, -(below + above), allowed);
  }
}

TEST(HeatBands, WithEqualEmissivitiesAreGrey) {
  Plates grey;
  grey.scene.bands.kind = Bands::Kind::grey;
  grey.set_materials(Eigen::VectorXd::Constant(1, 0.7), 700, Eigen::VectorXd::Constant(1, 0.4),
                     250);
  Plates banded;
  banded.scene.bands = {
      .kind = Bands::Kind::thermal, .wavelengths = {}, .edges = {1, 2, 3, 5, 8, 13, 21}};
  banded.set_materials(Eigen::VectorXd::Constant(8, 0.7), 700, Eigen::VectorXd::Constant(8, 0.4),
                       250);
  EXPECT_NEAR(banded.fluxes()[0].heat, grey.fluxes()[0].heat, 1e-8);
}

TEST(HeatBands, TellSolarAndInfraredApart) {
  Plates plates;
  plates.scene.bands.kind = Bands::Kind::solar_infrared;
  plates.set_materials(Eigen::Vector2d(0.2, 0.9), 350, Eigen::Vector2d(0.5, 0.6), 300);
  Eigen::MatrixXd sun = Eigen::MatrixXd::Zero(2, 2);
  sun(0, 0) = 1361;
  const std::vector<SurfaceFlux> fluxes = plates.fluxes(sun);
  // Of what comes on plate 1, α1 / (1 - ρ1 ρ2) stays there, and ρ1 α2 / (1 - ρ1 ρ2) on the other.
  const double all = 1 - 0.8 * 0.5;
  EXPECT_NEAR(-fluxes[0].band_heat[0], 1361 * 0.2 / all, 1e-8);
  EXPECT_NEAR(-fluxes[1].band_heat[0], 1361 * 0.8 * 0.5 / all, 1e-8);
  const double infrared =
      kStefanBoltzmann * (std::pow(350, 4) - std::pow(300, 4)) / (1 / 0.9 + 1 / 0.6 - 1);
  EXPECT_NEAR(fluxes[0].band_heat[1], infrared, 1e-8);
  EXPECT_NEAR(fluxes[0].heat, infrared - 1361 * 0.2 / all, 1e-8);
}

}  // namespace

#include "radiosity/scene/radiometry.h"

#include <gtest/gtest.h>

#include <cmath>

#include "radiosity/scene/patch_mesh.h"

namespace radiosity {
namespace {

Eigen::VectorXd values(std::initializer_list<double> list) {
  Eigen::VectorXd result(static_cast<Index>(list.size()));
  std::copy(list.begin(), list.end(), result.begin());
  return result;
}

/// Three surfaces: "floor", a unit square in two triangles; "light", a one-sided square of edge
/// 0.5; "sheet", two-sided, a unit square. Materials 0, 1, 2 in that order.
PatchMesh make_mesh() {
  PatchMesh mesh;
  mesh.vertices = {{0, 0, 0},     {1, 0, 0},   {1, 1, 0}, {0, 1, 0}, {0, 0, 2}, {0, 0.5, 2},
                   {0.5, 0.5, 2}, {0.5, 0, 2}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  mesh.surface_names = {"floor", "light", "sheet"};
  mesh.surface_two_sided = {false, false, true};
  mesh.add_patch({0, 1, 2, -1}, 0, 0);
  mesh.add_patch({0, 2, 3, -1}, 0, 0);
  mesh.add_patch({4, 5, 6, 7}, 1, 1);
  mesh.add_patch({8, 9, 10, 11}, 2, 2, 4);
  mesh.add_patch({11, 10, 9, 8}, 2, 2, 3);
  return mesh;
}

Scene make_scene(Bands::Kind bands, const Emission& light, const Emission& sheet,
                 const Eigen::VectorXd& reflectance) {
  Scene scene;
  scene.bands.kind = bands;
  scene.materials = {
      {"grey", reflectance, {}}, {"lamp", 0.5 * reflectance, light}, {"paper", reflectance, sheet}};
  scene.surfaces = {{"floor", 0, false}, {"light", 1, false}, {"sheet", 2, true}};
  return scene;
}

TEST(Radiometry, RadianceGivesPiTimesExitance) {
  const Scene scene =
      make_scene(Bands::Kind::rgb, {Emission::Kind::radiance, values({17, 12, 4})},
                 {Emission::Kind::exitance, values({1, 2, 3})}, values({0.2, 0.4, 0.6}));
  const Eigen::MatrixXd m = exitance(scene, make_mesh());
  ASSERT_EQ(m.rows(), 5);
  ASSERT_EQ(m.cols(), 3);
  EXPECT_EQ(m.topRows(2).norm(), 0);
  EXPECT_DOUBLE_EQ(m(2, 0), kPi * 17);
  EXPECT_DOUBLE_EQ(m(2, 2), kPi * 4);
  for (const Index side : {3, 4}) EXPECT_EQ(m.row(side), Eigen::RowVector3d(1, 2, 3));
}

TEST(Radiometry, PowerIsSpreadOverTheWholeSurface) {
  const PatchMesh mesh = make_mesh();
  const Scene scene = make_scene(Bands::Kind::grey, {Emission::Kind::power, values({100})},
                                 {Emission::Kind::power, values({30})}, values({0.5}));
  const Eigen::MatrixXd m = exitance(scene, mesh);
  EXPECT_DOUBLE_EQ(m(2, 0), 400);  // 100 W on 0.25 m²
  EXPECT_DOUBLE_EQ(m(3, 0), 15);   // 30 W on both sides of 1 m²
  double power = 0;
  for (Index i = 0; i < mesh.size(); ++i) power += mesh.area[i] * m(i, 0);
  EXPECT_DOUBLE_EQ(power, 130);
}

TEST(Radiometry, TemperatureFollowsStefanBoltzmann) {
  const Scene scene = make_scene(Bands::Kind::grey, {Emission::Kind::temperature, values({300})},
                                 {Emission::Kind::temperature, values({1000})}, values({0.2}));
  const Eigen::MatrixXd m = exitance(scene, make_mesh());
  // σ 300⁴ = 459.3003 W/m²; the lamp has ρ = 0.1, the paper 0.2.
  EXPECT_NEAR(m(2, 0), 0.9 * 459.30032793900, 1e-9);
  EXPECT_NEAR(m(3, 0), 0.8 * 56703.74419, 1e-9);
}

// Of whatever kind the emission is: the factor is of the power, and nothing else changes.
TEST(Radiometry, ASurfaceEmitsItsShareOfWhatItsMaterialDoes) {
  for (const auto kind : {Emission::Kind::radiance, Emission::Kind::exitance, Emission::Kind::power,
                          Emission::Kind::temperature}) {
    Scene scene =
        make_scene(Bands::Kind::grey, {kind, values({300})}, {kind, values({200})}, values({0.4}));
    const Eigen::MatrixXd full = exitance(scene, make_mesh());
    scene.surfaces[1].emission_factor = 0.25;
    scene.surfaces[2].emission_factor = 0;
    const Eigen::MatrixXd dimmed = exitance(scene, make_mesh());
    EXPECT_EQ(dimmed(2, 0), 0.25 * full(2, 0));
    EXPECT_EQ(dimmed.bottomRows(2).norm(), 0);
    EXPECT_GT(full.bottomRows(2).norm(), 0);
  }
}

TEST(Radiometry, ReflectanceFollowsTheMaterial) {
  const Scene scene = make_scene(Bands::Kind::rgb, {}, {}, values({0.2, 0.4, 0.6}));
  const Eigen::MatrixXd rho = reflectance(scene, make_mesh());
  EXPECT_EQ(rho.row(0), Eigen::RowVector3d(0.2, 0.4, 0.6));
  EXPECT_EQ(rho.row(2), Eigen::RowVector3d(0.1, 0.2, 0.3));
  EXPECT_EQ(rho.row(4), Eigen::RowVector3d(0.2, 0.4, 0.6));
  EXPECT_EQ(exitance(scene, make_mesh()).norm(), 0);
}

}  // namespace
}  // namespace radiosity

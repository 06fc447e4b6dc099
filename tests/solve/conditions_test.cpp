#include "radiosity/solve/conditions.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <random>
#include <string>

#include "radiosity/base/error.h"
#include "radiosity/scene/radiometry.h"
#include "radiosity/solve/solve.h"
#include "radiosity/solve/solve_conditions.h"
#include "radiosity/solve/surface_flux.h"
#include "tests/support/matrix_transport.h"
#include "tests/support/messages.h"

namespace radiosity {
namespace {

using test::DenseTestTransport;
using test::random_matrix;

constexpr std::uint64_t kHeatSeed = 20261128;

Emission emission(Emission::Kind kind, double value) {
  return {.kind = kind, .value = Eigen::VectorXd::Constant(1, value)};
}

Material material(double emissivity, Emission emission) {
  return {.name = "m",
          .reflectance = Eigen::VectorXd::Constant(1, 1 - emissivity),
          .emission = std::move(emission)};
}

/// A scene of flat patches, each a surface with a material of its own; where they lie does not
/// matter, for the exchange areas come with them.
struct Patches {
  Scene scene;
  PatchMesh mesh;

  Patches() { scene.bands.kind = Bands::Kind::grey; }

  void add(double area, const Material& front) { add_patch(area, front, -1); }
  /// Both sides of a sheet whose temperature floats, of this area each.
  void add_shield(double area, const Material& front, const Material& back) {
    add_patch(area, front, static_cast<std::int32_t>(mesh.size()) + 1);
    Surface& surface = scene.surfaces.back();
    surface.back_material = static_cast<int>(scene.materials.size());
    surface.is_shield = true;
    surface.two_sided = true;
    scene.materials.push_back(back);
    auto corners = mesh.corners.back();
    std::swap(corners[1], corners[3]);
    mesh.add_patch(corners, mesh.surface.back(), mesh.polygon.back(),
                   static_cast<std::int32_t>(mesh.size()) - 1);
    mesh.area.back() = area;
  }

 private:
  void add_patch(double area, const Material& front, std::int32_t twin) {
    const auto v = static_cast<std::int32_t>(mesh.vertices.size());
    const double x = 2 * static_cast<double>(mesh.vertices.size());
    for (const Vec3& p :
         {Vec3(x, 0, 0), Vec3(x + 1, 0, 0), Vec3(x + 1, area, 0), Vec3(x, area, 0)}) {
      mesh.vertices.push_back(p);
    }
    const auto s = static_cast<std::int32_t>(scene.surfaces.size());
    scene.surfaces.push_back(
        {.name = "s" + std::to_string(s), .material = static_cast<int>(scene.materials.size())});
    scene.materials.push_back(front);
    mesh.surface_names.push_back(scene.surfaces.back().name);
    mesh.surface_two_sided.push_back(twin >= 0);
    mesh.add_patch({v, v + 1, v + 2, v + 3}, s, s, twin);
    mesh.area.back() = area;
  }
};

Solution solve_heat(const Patches& patches, const Transport& transport,
                    const Eigen::VectorXd& added = {}) {
  const Conditions conditions = make_conditions(patches.scene, patches.mesh, transport, {}, added);
  SolveOptions options;
  options.tolerance = 1e-13;
  Solution solution = solve(transport, conditions.exitance, conditions.reflectance,
                            with_conditions(options, conditions, 1));
  solution.temperature = temperatures(patches.mesh, solution, conditions.emissivity);
  return solution;
}

double black(double kelvin) { return kStefanBoltzmann * std::pow(kelvin, 4); }

/// Two patches that see nothing but each other, as parallel plates without end.
DenseTestTransport facing(double area) {
  Eigen::MatrixXd exchange = Eigen::MatrixXd::Zero(2, 2);
  exchange(0, 1) = exchange(1, 0) = area;
  return {exchange, Eigen::VectorXd::Constant(2, area)};
}

// q = σ (T1⁴ - T2⁴) / (1/ε1 + 1/ε2 - 1) with ε .8 and .3: 0.27906976744 of σ (T1⁴ - T2⁴). Whichever
// of temperature and heat is given, the other follows.
TEST(Conditions, ParallelPlates) {
  const double q = 0.279069767441860 * (black(500) - black(300));
  Patches by_temperature;
  by_temperature.add(2, material(0.8, emission(Emission::Kind::temperature, 500)));
  by_temperature.add(2, material(0.3, emission(Emission::Kind::temperature, 300)));
  EXPECT_NEAR(solve_heat(by_temperature, facing(2)).net_flux()(0, 0), q, 1e-9 * q);

  for (const auto& heat :
       {emission(Emission::Kind::heat_flux, q), emission(Emission::Kind::heat_power, 2 * q)}) {
    Patches by_heat;
    by_heat.add(2, material(0.8, heat));
    by_heat.add(2, material(0.3, emission(Emission::Kind::temperature, 300)));
    const Solution solution = solve_heat(by_heat, facing(2));
    EXPECT_TRUE(solution.converged);
    EXPECT_NEAR(solution.net_flux()(0, 0), q, 1e-9 * q);
    EXPECT_NEAR(solution.temperature[0], 500, 1e-7);
    EXPECT_NEAR(solution.temperature[1], 300, 1e-7);
  }
  // Heat taken from the hot plate's opposite: negative.
  Patches cooled;
  cooled.add(2, material(0.8, emission(Emission::Kind::temperature, 500)));
  cooled.add(2, material(0.3, emission(Emission::Kind::heat_flux, -q)));
  EXPECT_NEAR(solve_heat(cooled, facing(2)).temperature[1], 300, 1e-7);
}

// Heat of the sun on a plate is given off by it besides.
TEST(Conditions, AddedHeatCountsWhereHeatIsGiven) {
  const double q = 0.279069767441860 * (black(500) - black(300));
  Patches patches;
  patches.add(2, material(0.8, emission(Emission::Kind::heat_flux, q - 10)));
  patches.add(2, material(0.3, emission(Emission::Kind::temperature, 300)));
  const Solution solution = solve_heat(patches, facing(2), Eigen::Vector2d(10, 55));
  EXPECT_NEAR(solution.temperature[0], 500, 1e-7);
}

// A long duct whose section is a right triangle of sides 3, 4 and 5, factors by crossed strings:
// what is given as heat comes back as the temperatures that make that heat, and the other way
// round.
TEST(Conditions, TriangularDuct) {
  const Eigen::Vector3d side(3, 4, 5);
  Eigen::MatrixXd exchange = Eigen::MatrixXd::Zero(3, 3);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (i != j) exchange(i, j) = (side[i] + side[j] - side[3 - i - j]) / 2;
    }
  }
  const DenseTestTransport duct(exchange, side);
  const double kelvin[] = {1000, 700, 400};
  const double emissivity[] = {0.9, 0.5, 0.25};
  Patches given;
  for (int i = 0; i < 3; ++i) {
    given.add(side[i], material(emissivity[i], emission(Emission::Kind::temperature, kelvin[i])));
  }
  const Eigen::MatrixXd heat = solve_heat(given, duct).net_flux();
  EXPECT_NEAR(side.dot(heat.col(0)), 0, 1e-9 * side[0] * heat(0, 0));
  for (int known = 0; known < 3; ++known) {
    Patches mixed;
    for (int i = 0; i < 3; ++i) {
      mixed.add(side[i], material(emissivity[i],
                                  i == known ? emission(Emission::Kind::temperature, kelvin[i])
                                             : emission(Emission::Kind::heat_flux, heat(i, 0))));
    }
    const Solution solution = solve_heat(mixed, duct);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(solution.temperature[i], kelvin[i], 1e-6) << known;
  }
}

/// The same by unknowns B and σ T⁴ of each patch and nothing eliminated, by dense LU: σ T⁴, n.
Eigen::VectorXd black_by_lu(const Patches& patches, const Eigen::MatrixXd& f, double environment) {
  const Index n = patches.mesh.size();
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  Eigen::VectorXd y = Eigen::VectorXd::Zero(2 * n);
  const Eigen::VectorXd entering = environment * (1 - f.rowwise().sum().array());
  const Eigen::MatrixXd less_gathered = Eigen::MatrixXd::Identity(n, n) - f;  // of B: B - F B
  for (Index i = 0; i < n; ++i) {
    const Material& m = patches.scene.materials[material_of(patches.scene, patches.mesh, i)];
    const double e = 1 - m.reflectance[0];
    // B = ε σ T⁴ + (1 - ε) (F B + H_0)
    a(i, i) += 1;
    a.row(i).head(n) -= (1 - e) * f.row(i);
    a(i, n + i) = -e;
    y[i] = (1 - e) * entering[i];
    const Index twin = patches.mesh.twin[i];
    if (twin >= 0 && twin < i) {
      a(n + i, n + i) = 1;  // as warm as the other side
      a(n + i, n + twin) = -1;
    } else if (twin >= 0) {
      a.row(n + i).head(n) = less_gathered.row(i) + less_gathered.row(twin);
      y[n + i] = entering[i] + entering[twin];
    } else if (m.emission.kind == Emission::Kind::temperature) {
      a(n + i, n + i) = 1;
      y[n + i] = black(m.emission.value[0]);
    } else {
      a.row(n + i).head(n) = less_gathered.row(i);
      y[n + i] = m.emission.value[0] + entering[i];
    }
  }
  return a.partialPivLu().solve(y).tail(n);
}

TEST(Conditions, RandomEnclosuresAgreeWithDenseLu) {
  std::mt19937_64 random(kHeatSeed);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int trial = 0; trial < 20; ++trial) {
    const Index n = 16;
    const Index n_sides = 2 * (trial % 4);
    Eigen::MatrixXd g = random_matrix(n, n, 0, 1, random);
    g = (g + g.transpose()).eval();
    Eigen::VectorXd area = g.rowwise().sum();
    for (Index i = 0; i < n_sides; i += 2) {
      const Index thin = area[i] < area[i + 1] ? i : i + 1;
      const double lacking = std::abs(area[i] - area[i + 1]);
      g(thin, thin) += lacking;
      area[thin] += lacking;
    }
    const bool is_open = trial % 2 == 1;
    const DenseTestTransport transport(is_open ? 0.7 * g : g, area);
    Patches patches;
    const auto any = [&] { return 0.05 + 0.95 * uniform(random); };
    for (Index i = 0; i < n_sides; i += 2) {
      patches.add_shield(area[i], material(any(), {}), material(any(), {}));
    }
    for (Index i = n_sides; i < n; ++i) {
      const bool is_warm = i == n - 1 || uniform(random) < 0.5;
      patches.add(
          area[i],
          material(any(), is_warm
                              ? emission(Emission::Kind::temperature, 300 + 400 * uniform(random))
                              : emission(Emission::Kind::heat_flux, 200 * uniform(random))));
    }
    if (is_open) patches.scene.environment = emission(Emission::Kind::temperature, 250);
    const Solution solution = solve_heat(patches, transport);
    EXPECT_TRUE(solution.converged);
    const Eigen::VectorXd expected =
        black_by_lu(patches, transport.form_factors(), is_open ? black(250) : 0);
    for (Index i = 0; i < n; ++i) {
      EXPECT_NEAR(black(solution.temperature[i]), expected[i], 1e-8 * expected.maxCoeff())
          << "trial " << trial << ", patch " << i;
    }
    const EnergyBalance& energy = solution.energy;
    EXPECT_NEAR(energy.emitted[0] + energy.incident[0], energy.absorbed[0] + energy.escaped[0],
                1e-10 * std::abs(energy.absorbed[0]));
  }
}

TEST(Conditions, ColderThanAbsoluteZeroIsRefused) {
  Patches patches;
  patches.add(2, material(0.8, emission(Emission::Kind::temperature, 300)));
  patches.add(2, material(0.3, emission(Emission::Kind::heat_flux, -500)));
  try {
    (void)solve_heat(patches, facing(2));
    ADD_FAILURE() << "accepted";
  } catch (const SolveError& error) {
    test::expect_contains(error.what(), "surface 's1': patch 1 would have to be below absolute");
  }
}

// Temperatures that are given are told as they were, 0 K among them, however the iteration ends;
// of what emits otherwise that which would give off as much.
TEST(Conditions, GivenTemperaturesComeOutAsTheyWere) {
  const Emission::Kind kinds[] = {Emission::Kind::temperature, Emission::Kind::temperature,
                                  Emission::Kind::exitance};
  const double given[] = {0, 377, 250};
  const double emissivities[] = {0.3, 0.05, 0.8};
  for (int k = 0; k < 3; ++k) {
    Patches patches;
    patches.add(2, material(0.6, emission(Emission::Kind::temperature, 500)));
    patches.add(2, material(emissivities[k], emission(kinds[k], given[k])));
    const DenseTestTransport transport = facing(2);
    const Conditions conditions = make_conditions(patches.scene, patches.mesh, transport);
    const Solution rough = solve(patches.mesh, transport, conditions,
                                 with_conditions({.tolerance = 1e-3}, conditions, 1));
    const double expected = kinds[k] == Emission::Kind::temperature
                                ? given[k]
                                : std::pow(given[k] / (emissivities[k] * kStefanBoltzmann), 0.25);
    EXPECT_NEAR(temperatures(patches.mesh, rough, conditions.emissivity)[1], expected,
                1e-14 * expected);
  }
}

// A shield between lamps is at the mean of what both sides absorb, though nothing has a
// temperature: σ T⁴ = (ε H + ε' H') / (ε + ε'), H = M_1 + ρ_1 B where plates face each other.
TEST(Conditions, ShieldsAloneMakeLightHeat) {
  Patches patches;
  patches.add(1, material(1, emission(Emission::Kind::exitance, 300)));
  patches.add(1, material(1, emission(Emission::Kind::exitance, 900)));
  patches.add_shield(1, material(0.2, {}), material(0.5, {}));
  EXPECT_TRUE(is_thermal(patches.scene));
  Eigen::MatrixXd exchange = Eigen::MatrixXd::Zero(4, 4);
  exchange(0, 2) = exchange(2, 0) = exchange(1, 3) = exchange(3, 1) = 1;
  const Solution solution =
      solve_heat(patches, DenseTestTransport(exchange, Eigen::VectorXd::Ones(4)));
  EXPECT_NEAR(black(solution.temperature[2]), (0.2 * 300 + 0.5 * 900) / 0.7, 1e-9 * 900);
  EXPECT_NEAR(solution.temperature[3], solution.temperature[2], 1e-9 * 300);
}

// Nothing fixes the temperatures of patches that see only each other, whatever heat is given.
TEST(Conditions, FloatingGroupsAreRefusedByName) {
  const double fluxes[][2] = {{0, 0}, {3, -3}, {3, 4}};
  const char* expected[] = {"adds up to 0", "adds up to 0", "14 W are given to it"};
  for (int k = 0; k < 3; ++k) {
    Patches patches;
    for (const double q : fluxes[k]) {
      patches.add(2, material(0.4, emission(Emission::Kind::heat_flux, q)));
    }
    const DenseTestTransport transport = facing(2);
    const Conditions conditions = make_conditions(patches.scene, patches.mesh, transport);
    try {
      (void)solve(patches.mesh, transport, conditions, with_conditions({}, conditions, 1));
      ADD_FAILURE() << "accepted " << k;
    } catch (const SolveError& error) {
      test::expect_contains(error.what(), "leaves it: s0, s1");
      test::expect_contains(error.what(), expected[k]);
    }
  }
}

}  // namespace
}  // namespace radiosity

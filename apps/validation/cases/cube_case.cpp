#include <fmt/format.h>

#include <cmath>

#include "apps/validation/cases/asked.h"
#include "apps/validation/cases/cases.h"
#include "apps/validation/reference/built_scenes.h"
#include "apps/validation/reference/known_factors.h"
#include "apps/validation/reference/own_light.h"
#include "radiosity/operator/transport.h"
#include "radiosity/solve/solution.h"

namespace apps::validation {
namespace {

using namespace radiosity;

Scene cube(double rho) {
  Scene scene = empty_scene("unit cube");
  scene.closed = true;
  const std::vector<Polygon> faces = box_faces(Vec3::Zero(), Vec3::Ones(), Facing::inwards);
  for (std::size_t k = 0; k < faces.size(); ++k) {
    add_surface(scene, fmt::format("face {}", k), {faces[k]},
                {.reflectance = rho, .exitance = k == 0 ? 1. : 0.});
  }
  return scene;
}

void check_factors(CaseResult& result, const Transport& transport,
                   const std::vector<KnownFactor>& known) {
  const KnownFactor& interior = known_factor(known, "cube interior");
  const double opposite = interior.value("F_opposite");
  const double adjacent = interior.value("F_adjacent");
  double worst = 0;
  for (Index i = 0; i < 6; ++i) {
    const Eigen::VectorXd row = rows_of(transport).row(i);
    for (Index j = 0; j < 6; ++j) {
      if (i == j) continue;
      const double expected = (i ^ 1) == j ? opposite : adjacent;
      worst = std::max(worst, std::abs(row[j] / expected - 1));
    }
  }
  result.checks.push_back({"all 30 form factors: max relative error", worst, kAskedOfFactors,
                           "What the program promises for unobstructed pairs."});
}

void check_radiosity(CaseResult& result, Table& table, const KnownFactor& known,
                     const Context& context) {
  const double rho = known.params.at("rho");
  const study::Study assembly =
      study::assemble(cube(rho), {.patches = {.as_is = true}, .seed = context.seed});
  const Solution solution = solve_own_light(assembly, {.tolerance = kAskedOfSolver});
  Eigen::VectorXd expected = Eigen::VectorXd::Constant(6, known.value("B2"));
  expected[0] = known.value("B0");
  expected[1] = known.value("B1");
  const double error = (solution.radiosity.col(0) - expected).norm() / expected.norm();
  result.checks.push_back(
      {fmt::format("ρ = {}: ‖ΔB‖/‖B‖", rho), error,
       kAskedOfSolver + kAskedOfFactors * rho / (1 - rho),
       "Solver's guaranteed bound 1e-8, and form factors that are off by 1e-9, which "
       "interreflection multiplies by ρ/(1-ρ) at most."});
  for (Index i = 0; i < 3; ++i) {
    const double computed = solution.radiosity(i, 0);
    table.rows.push_back({fmt::format("B of face {}, ρ = {}", i, rho),
                          fmt::format("{:.12f}", computed), fmt::format("{:.12f}", expected[i]),
                          fmt::format("{:.1e}", std::abs(computed / expected[i] - 1))});
  }
}

}  // namespace

CaseResult run_cube(const Context& context) {
  CaseResult result{
      .compared =
          "The unit cube with one patch per face, one of which emits 1 W/m²: all form "
          "factors, and the radiosity for ρ = 0.5 and 0.95.",
      .reference =
          "Closed forms of the 6 x 6 system to 30 digits (tests/data/form-factors.json); "
          "F of opposite faces 0.19982..., of adjacent ones 0.20004..."};
  const std::vector<KnownFactor> known = read_known_factors(context.data);
  const study::Study assembly =
      study::assemble(cube(0.5), {.patches = {.as_is = true}, .seed = context.seed});
  check_factors(result, *assembly.transport, known);
  Table table{"Radiosity, W/m²", {"", "computed", "closed form", "relative error"}, {}};
  check_radiosity(result, table, known_factor(known, "unit cube, 6 patches (one per face)"),
                  context);
  check_radiosity(result, table, known_factor(known, "unit cube, 6 patches, rho=0.95"), context);
  result.figures.emplace_back(table);
  return result;
}

}  // namespace apps::validation

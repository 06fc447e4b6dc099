#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/validation/cases/asked.h"
#include "apps/validation/cases/cases.h"
#include "apps/validation/reference/own_light.h"
#include "io/scene/scene_file.h"
#include "radiosity/solve/solution.h"
#include "radiosity/solve/solve.h"

namespace apps::validation {
namespace {

using namespace radiosity;

constexpr double kFurnaceReflectances[] = {0, 0.2, 0.5, 0.8, 0.9, 0.95, 0.99};

struct Furnace {
  const char* file;
  const char* name;
  meshing::PatchChoice patches;
};

/// Largest relative deviation of B from M / (1 - ρ), M = 1.
double deviation(const study::Study& room, double rho, const Progress& progress) {
  const Eigen::MatrixXd ones = Eigen::MatrixXd::Ones(room.mesh.size(), 1);
  SolveOptions options{.tolerance = kAskedOfSolver};
  options.progress.stop = progress.stop;
  const Solution solution = solve(*room.transport, ones, rho * ones, options);
  return (solution.radiosity.array() * (1 - rho) - 1).abs().maxCoeff();
}

double asked(const study::Study& room, double rho) {
  const double smallest = areas(room.mesh).minCoeff();
  return kAskedOfSolver * std::sqrt(areas(room.mesh).sum() / smallest) +
         kAskedOfRowSums * rho / (1 - rho);
}

}  // namespace

CaseResult run_furnace(const Context& context) {
  CaseResult result{
      .compared =
          "The radiosity B of closed rooms whose patches all have the same reflectance ρ and "
          "exitance M = 1 W/m²: a cube, and an L-shaped room where half of the patches do "
          "not see each other.",
      .reference =
          "B = M / (1 - ρ) on every patch, whatever the shape: a closed room with ΣF = 1 "
          "leaves nothing else. The classical white furnace test."};
  Plot plot{"Largest relative error of B over the patches",
            {"reflectance ρ"},
            {"relative error", Axis::Scale::logarithmic},
            {}};
  for (const Furnace& room : {Furnace{"furnace-cube.json", "cube", {.max_edge = 0.1}},
                              Furnace{"l-room.json", "L-shaped room", {.n_patches = 800}}}) {
    context.progress.check();
    const study::Study assembly = study::assemble(
        io::read_scene(context.scenes / room.file), {.patches = room.patches, .seed = context.seed},
        {.progress = {.report = {}, .stop = context.progress.stop}});
    Series measured{fmt::format("{}, {} patches", room.name, assembly.mesh.size())};
    Series limit{fmt::format("{}: asked", room.name), Series::Style::dashed};
    for (const double rho : kFurnaceReflectances) {
      const double error = deviation(assembly, rho, context.progress);
      const double tolerance = asked(assembly, rho);
      measured.x.push_back(rho);
      measured.y.push_back(std::max(error, 1e-16));
      limit.x.push_back(rho);
      limit.y.push_back(tolerance);
      result.checks.push_back(
          {fmt::format("{}, ρ = {}: max |B (1-ρ)/M - 1|", room.name, rho), error, tolerance,
           "The solver guarantees ‖ΔB‖ ≤ 1e-8 ‖B‖ in the energy norm, so that a patch of area A "
           "is off by 1e-8 √(S/A) at most (S all areas); row sums off by the 1e-10 that is "
           "promised change B by 1e-10 ρ/(1-ρ)."});
    }
    result.checks.push_back(
        {fmt::format("{}: max |ΣF - 1|", room.name),
         (assembly.transport->apply(Eigen::MatrixXd::Ones(assembly.mesh.size(), 1)).array() - 1)
             .abs()
             .maxCoeff(),
         kAskedOfRowSums, "What docs/command-line.md promises for closed scenes."});
    plot.series.push_back(measured);
    plot.series.push_back(limit);
  }
  result.notes.emplace_back("Errors below 1e-16 are drawn at 1e-16.");
  result.figures.emplace_back(plot);
  return result;
}

}  // namespace apps::validation

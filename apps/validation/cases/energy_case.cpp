#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/validation/cases/asked.h"
#include "apps/validation/cases/cases.h"
#include "apps/validation/reference/own_light.h"
#include "io/scene/scene_file.h"
#include "radiosity/scene/radiometry.h"
#include "radiosity/solve/solution.h"

namespace apps::validation {
namespace {

using namespace radiosity;

constexpr long kPatchesOfScene = 600;
constexpr double kFactorTolerance = 1e-2;  // asked of the form factors, the default

std::vector<std::filesystem::path> scene_files(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  if (files.empty()) throw SceneError(fmt::format("{}: no .json scenes there", folder.string()));
  return files;
}

/// How far the balance of one band is off, and may be, relative to the emitted power.
struct Imbalance {
  double value = 0;
  double allowed = 0;
};

/// The band whose balance uses up most of what it may.
Imbalance worst_imbalance(const Solution& solution, const Eigen::VectorXd& area) {
  Imbalance worst;
  const EnergyBalance& energy = solution.energy;
  for (Index c = 0; c < energy.emitted.size(); ++c) {
    const double emitted = energy.emitted[c];
    if (emitted == 0) continue;
    const double norm = std::sqrt(area.dot(solution.exitance.col(c).cwiseAbs2()));
    const double rounding =
        static_cast<double>(area.size()) * std::numeric_limits<double>::epsilon();
    const Imbalance found{std::abs(energy.absorbed[c] + energy.escaped[c] - emitted) / emitted,
                          solution.residual * norm * std::sqrt(area.sum()) / emitted +
                              rounding * area.dot(solution.radiosity.col(c)) / emitted};
    if (worst.allowed == 0 || found.value * worst.allowed > worst.value * found.allowed) {
      worst = found;
    }
  }
  return worst;
}

/// Nothing escapes from a closed room.
void check_closed(CaseResult& result, const std::string& name, const study::Study& room,
                  const Solution& solution) {
  const Eigen::VectorXd power = solution.radiosity.transpose() * areas(room.mesh);
  const Eigen::ArrayXd share =
      solution.energy.escaped.array() / power.array().max(std::numeric_limits<double>::min());
  const std::int64_t open_rows = room.transport->report().open_rows;
  Check check{fmt::format("{}: escaped / Σ A B, a closed room", name), share.abs().maxCoeff(),
              kAskedOfRowSums, "Row sums of closed scenes are 1 within 1e-10, as promised."};
  if (open_rows > 0) {
    check.tolerance = kFactorTolerance;
    check.derivation = fmt::format(
        "The relative error asked of the form factors, 1e-2, since {} of {} patches are reported "
        "as open: their errors are larger than sampling explains, and they are not corrected.",
        open_rows, room.mesh.size());
    result.notes.push_back(fmt::format(
        "{}: {} of {} patches are taken as seeing an opening, though the room is closed. The "
        "program warns of this.",
        name, open_rows, room.mesh.size()));
  }
  result.checks.push_back(check);
}

std::string watts(double power) { return fmt::format("{:.6g}", power); }

}  // namespace

CaseResult run_energy(const Context& context) {
  CaseResult result{.compared =
                        "Emitted power, Σ A M, with the power absorbed, Σ A (1-ρ) H, and escaped, "
                        "Σ A B (1-ΣF), in every scene of scenes/, about 600 patches each.",
                    .reference = "Energy conservation."};
  Table table{"Powers of all bands together, W",
              {"scene", "patches", "emitted", "absorbed", "escaped", "imbalance / emitted"},
              {}};
  for (const auto& file : scene_files(context.scenes)) {
    context.progress.check();
    const Progress quiet{.report = {}, .stop = context.progress.stop};
    Scene scene = io::read_scene(file);
    meshing::PatchChoice patches{.as_is = true};
    if (scene.n_polygons() < kPatchesOfScene / 2) patches = {.n_patches = kPatchesOfScene};
    const study::Study assembly = study::assemble(
        std::move(scene), {.patches = patches, .tolerance = kFactorTolerance, .seed = context.seed},
        {.progress = quiet});
    const Solution solution = solve_own_light(assembly, {.progress = quiet});
    const Imbalance imbalance = worst_imbalance(solution, areas(assembly.mesh));
    const std::string name = file.stem().string();
    result.checks.push_back(
        {fmt::format("{}: |emitted - absorbed - escaped| / emitted", name), imbalance.value,
         imbalance.allowed,
         "The imbalance is Σ A r, r the residual of B = M + ρ F B, hence at most ‖r‖ √S by Cauchy "
         "and Schwarz, with the residual that the solver reports; and n roundings. The largest "
         "over the bands."});
    if (assembly.scene.closed.value_or(false)) check_closed(result, name, assembly, solution);
    table.rows.push_back(
        {name, std::to_string(assembly.mesh.size()), watts(solution.energy.emitted.sum()),
         watts(solution.energy.absorbed.sum()), watts(solution.energy.escaped.sum()),
         fmt::format("{:.1e}", imbalance.value)});
  }
  result.figures.emplace_back(table);
  return result;
}

}  // namespace apps::validation

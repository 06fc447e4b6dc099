#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/validation/cases/cases.h"
#include "apps/validation/reference/own_light.h"
#include "io/scene/scene_file.h"
#include "radiosity/scene/radiometry.h"
#include "radiosity/solve/solution.h"
#include "radiosity/solve/solve.h"

namespace apps::validation {
namespace {

using namespace radiosity;

constexpr long kPatchesOfBox = 600;
/// Two solves, each this good in the energy norm, differ by at most 1e-10.
constexpr double kAskedOfBands = 4e-11;
constexpr double kSingles[] = {500, 600, 700};  // nm
constexpr const char* kShown[] = {"floor", "left", "right", "short_top"};

void check_single(CaseResult& result, const study::Study& box, const Solution& all,
                  double wavelength, const Progress& progress) {
  const std::vector<double>& wavelengths = box.scene.bands.wavelengths;
  const auto found = std::find(wavelengths.begin(), wavelengths.end(), wavelength);
  if (found == wavelengths.end()) {
    throw SceneError(fmt::format("{}: there is no band of {} nm", box.scene.source, wavelength));
  }
  const Index c = found - wavelengths.begin();
  const Solution alone = solve(*box.transport, all.exitance.col(c), all.reflectance.col(c),
                               {.tolerance = kAskedOfBands, .on_step = {}, .progress = progress});
  const Eigen::VectorXd root = areas(box.mesh).cwiseSqrt();
  const double difference =
      (all.radiosity.col(c) - alone.radiosity.col(0)).cwiseProduct(root).norm() /
      alone.radiosity.col(0).cwiseProduct(root).norm();
  result.checks.push_back({fmt::format("{} nm among all bands and alone: ‖ΔB‖/‖B‖", wavelength),
                           difference, 1e-10,
                           "Both are solved to a guaranteed 4e-11 in this norm, so that they "
                           "differ by 8e-11 at most."});
}

void check_energy(CaseResult& result, const study::Study& box, const Solution& all) {
  const Eigen::VectorXd area = areas(box.mesh);
  double worst = 0;
  for (Index c = 0; c < all.radiosity.cols(); ++c) {
    const double emitted = all.energy.emitted[c];
    const double imbalance = std::abs(all.energy.absorbed[c] + all.energy.escaped[c] - emitted);
    const double allowed =
        all.residual * std::sqrt(area.dot(all.exitance.col(c).cwiseAbs2()) * area.sum()) +
        static_cast<double>(area.size()) * std::numeric_limits<double>::epsilon() *
            area.dot(all.radiosity.col(c));
    if (imbalance > 0) worst = std::max(worst, imbalance / allowed);
  }
  result.checks.push_back(
      {fmt::format("energy balance of {} bands: max imbalance / allowed", all.radiosity.cols()),
       worst, 1,
       "Allowed is ‖r‖ √S, r the residual of B = M + ρ F B that the solver reports, by Cauchy and "
       "Schwarz; and n roundings."});
}

/// Mean radiosity of a surface by wavelength.
Series spectrum(const study::Study& box, const Solution& all, const std::string& surface) {
  Series series{surface, Series::Style::line};
  Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(all.radiosity.cols());
  double area = 0;
  for (Index i = 0; i < box.mesh.size(); ++i) {
    if (box.mesh.surface_names[box.mesh.surface[i]] != surface) continue;
    sum += box.mesh.area[i] * all.radiosity.row(i);
    area += box.mesh.area[i];
  }
  if (area == 0) return series;
  for (Index c = 0; c < sum.size(); ++c) {
    series.x.push_back(box.scene.bands.wavelengths[c]);
    series.y.push_back(sum[c] / area);
  }
  return series;
}

}  // namespace

CaseResult run_spectral(const Context& context) {
  const auto path = context.scenes / "cornell-box-spectral.json";
  if (!std::filesystem::exists(path)) {
    throw Skipped(fmt::format("{}: there is no such scene", path.string()));
  }
  const Progress quiet{.report = {}, .stop = context.progress.stop};
  const study::Study box = study::assemble(
      io::read_scene(path), {.patches = {.n_patches = kPatchesOfBox}, .seed = context.seed},
      {.progress = quiet});
  if (box.scene.bands.kind != Bands::Kind::wavelengths) {
    throw SceneError(fmt::format("{}: expected bands by wavelength", path.string()));
  }
  const Solution all =
      solve_own_light(box, {.tolerance = kAskedOfBands, .on_step = {}, .progress = quiet});
  CaseResult result{.compared = fmt::format(
                        "The Cornell box with its measured spectra, {} bands solved together, "
                        "{} patches.",
                        box.scene.bands.count(), box.mesh.size()),
                    .reference = "Single bands solved alone; energy conservation in every band."};
  for (const double wavelength : kSingles) check_single(result, box, all, wavelength, quiet);
  check_energy(result, box, all);
  Plot plot{"Mean radiosity of some surfaces", {"wavelength, nm"}, {"B, W/m² per band"}, {}};
  for (const char* surface : kShown) plot.series.push_back(spectrum(box, all, surface));
  result.figures.emplace_back(plot);
  return result;
}

}  // namespace apps::validation

#include "study/warnings.h"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "meshing/inspect/inspect.h"
#include "radiosity/exchange/cut_off.h"
#include "radiosity/scene/celsius.h"
#include "radiosity/scene/patch_heat.h"
#include "radiosity/scene/patch_material.h"
#include "radiosity/scene/patch_texture.h"

namespace study {

using namespace radiosity;

namespace {

void warn_of_celsius(const GivenHeat& given, const StudyEvents& events) {
  std::vector<double> kelvins;
  for (const auto& [number, kelvin] : given.values) kelvins.push_back(kelvin);
  if (const auto warning = celsius_warning(kelvins)) {
    events.warn(given.source + ": " + *warning);
  }
}

}  // namespace

void warn_of_findings(const Scene& scene, const StudyEvents& events) {
  if (!events.warned) return;
  for (const std::string& message : meshing::serious_findings(scene)) events.warn(message);
}

void warn_of_cut_off(const Scene& scene, const PatchMesh& mesh, const StudyEvents& events) {
  if (!events.warned || scene.symmetry.translations.empty()) return;
  const Eigen::VectorXd bound = cut_off_bound(mesh, scene.symmetry);
  Index worst = 0;
  const double most = bound.maxCoeff(&worst);
  events.warn(fmt::format(
      "the repeated scene is cut off: beyond its images goes at most {:.2g} of what a patch sends "
      "(surface '{}'), {:.2g} on average, which counts as escaped",
      most, mesh.surface_names[mesh.surface[worst]], bound.mean()));
}

void warn_of_partly_given_heat(const Scene& scene, const PatchMesh& mesh,
                               const StudyEvents& events) {
  (void)patch_heat(scene, mesh);
  for (const GivenHeat& given : scene.given_heat) {
    if (given.kind == GivenHeat::Kind::temperature) warn_of_celsius(given, events);
    const auto n = static_cast<Index>(given.values.size());
    if (given.of != GivenHeat::Of::patches || n == mesh.size()) continue;
    events.warn(fmt::format(
        "{}: tells of {} of {} patches; the others are as their materials say. If that was not "
        "meant, the patches are not those of the file: they depend on --patches and the like",
        given.source, n, mesh.size()));
  }
}

std::optional<std::string> open_rows_warning(const AssemblyReport& report) {
  if (report.open_rows == 0) return std::nullopt;
  return fmt::format(
      "the scene is taken as closed, but {} of {} patches see an opening; "
      "their form factors stay as they are (--closed no leaves all so)",
      report.open_rows, report.row_sums.size());
}

void warn_of_open_rows(const AssemblyReport& report, const StudyEvents& events) {
  if (const auto warning = open_rows_warning(report)) events.warn(*warning);
}

void warn_of_textures(const Scene& scene, const PatchMesh& mesh, const StudyEvents& events) {
  constexpr double kStrong = 0.1;  // of the deviation, over all patches with textures
  if (!events.warned) return;
  const Eigen::VectorXd deviation = radiosity::texture_deviation(scene, mesh);
  double area = 0;
  double square = 0;
  Index worst = 0;
  for (Index i = 0; i < deviation.size(); ++i) {
    if (!scene.materials[material_of(scene, mesh, i)].texture) continue;
    area += mesh.area[i];
    square += mesh.area[i] * deviation[i] * deviation[i];
    if (deviation[i] > deviation[worst]) worst = i;
  }
  const double strength = area > 0 ? std::sqrt(square / area) : 0;
  if (!(strength > kStrong)) return;
  events.warn(fmt::format(
      "textures vary within patches, which have their means: the reflectance by {:.2f} (standard "
      "deviation), {:.2f} in patch {} of '{}'; more patches follow them (--patches N, --adaptive)",
      strength, deviation[worst], worst, mesh.surface_names[mesh.surface[worst]]));
}

void warn_of_darkness(const Eigen::MatrixXd& exitance, const Eigen::MatrixXd& incident,
                      const StudyEvents& events) {
  const bool is_sunless = incident.size() == 0 || incident.isZero(0);
  if (incident.size() > 0 && is_sunless) {
    events.warn("no light of sun or luminaires reaches a surface's emitting side");
  }
  if (exitance.isZero(0) && is_sunless) {
    events.warn("no surface emits light: the radiosity is zero everywhere");
  }
}

void warn_of_unverified(const AssemblyReport& report, double tolerance, const StudyEvents& events) {
  if (!report.compression || report.compression->verified_error <= tolerance) return;
  events.warn(fmt::format(
      "the compressed form factors are off by up to {:.2g}, more than the {:.2g} that was asked; "
      "--transport dense has no such limit",
      report.compression->verified_error, tolerance));
}

void warn_of_unverified(const VerifiedLight& verified, double tolerance,
                        const StudyEvents& events) {
  if (verified.error <= tolerance) return;
  events.warn(fmt::format(
      "for this light the compressed form factors are off by up to {:.2g}, more than the {:.2g} "
      "that was asked of them; they may be made anew for it",
      verified.error, tolerance));
}

void warn_of_spent_patches(const meshing::Refinement& refinement, Index n_patches, double tolerance,
                           const StudyEvents& events) {
  if (refinement.is_accurate) return;
  events.warn(
      fmt::format("the patches ({}) are spent: the error of the radiosity is about "
                  "{:.2g}, {:.2g} was asked for (--patches N allows more)",
                  n_patches, refinement.error, tolerance));
}

bool is_size_unknown(const DiscretisationError& discretisation) {
  return discretisation.unknown_share > 0.5;
}

void warn_of_unknown_size(const DiscretisationError& discretisation, const Solution& solution,
                          const StudyEvents& events) {
  if (!is_size_unknown(discretisation)) return;
  const std::string which =
      discretisation.n_unknown == solution.radiosity.rows()
          ? "each surface has one patch only"
          : fmt::format("{:.0f} % of the reflected light is that of surfaces of one patch only",
                        100 * discretisation.unknown_share);
  events.warn(which +
              ": without coarser ones to compare with, what their size makes wrong may be more "
              "than the errors given say; --patches N makes more");
}

void warn_of_unconverged(const Solution& solution, const SolveOptions& options,
                         const StudyEvents& events) {
  if (solution.converged) return;
  const bool is_fastest = options.method == Method::conjugate_gradients;
  events.warn(
      fmt::format("the iteration has not converged: its error may be {:.1e}, {:.1e} "
                  "was asked for{}",
                  solution.error_bound, options.tolerance, is_fastest ? "" : "; try --method cg"));
}

}  // namespace study

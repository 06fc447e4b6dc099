#include "study/row_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "meshing/inspect/inspect.h"
#include "radiosity/base/error.h"

namespace study {
namespace {

using namespace radiosity;

/// Rules may be off by more than they tell where patches touch; what is nonsense is more than that.
constexpr double kLeastExcess = 0.01;
/// As closure reckons: independent entries by their root, alike ones by their sum.
constexpr double kSigmas = 6;

/// Patches are small for the digits of their corners if they are fewer half units of the last one.
constexpr double kFewPrecisions = 100;

std::string cause(const Scene& scene, double size) {
  if (const auto overlap = meshing::overlap_finding(scene)) return *overlap;
  if (size < kFewPrecisions * scene.precision) {
    return fmt::format(
        "it is {:.2g} m large where coordinates are taken as rounded to {:.2g} m; they need more "
        "digits, or a smaller --precision if they have them",
        size, scene.precision);
  }
  return "radiosity inspect shows what is wrong with the scene";
}

}  // namespace

void refuse_excess(const Scene& scene, const PatchMesh& mesh, const AssemblyReport& report,
                   double tolerance, const std::function<Eigen::VectorXd(Index)>& row_error) {
  if (report.row_sums.size() == 0) return;
  Index worst = 0;
  const double sum = report.row_sums.maxCoeff(&worst);
  const double allowed = 1 + std::max(tolerance, kLeastExcess);
  if (sum <= allowed) return;
  const Eigen::VectorXd errors = row_error(worst);
  if (sum <= allowed + kSigmas * errors.norm() + errors.sum()) return;
  throw SolveError(fmt::format(
      "{}: the form factors of a patch of surface '{}', polygon {}, add up to {:.4g}, but no more "
      "than 1 can be: {}",
      scene.source, mesh.surface_names[mesh.surface[worst]], mesh.polygon[worst], sum,
      cause(scene, std::sqrt(mesh.area[worst]))));
}

}  // namespace study

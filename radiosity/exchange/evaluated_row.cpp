#include "radiosity/exchange/evaluated_row.h"

#include <algorithm>

#include "radiosity/base/parallel.h"
#include "radiosity/exchange/exchange_evaluator.h"
#include "radiosity/scene/whole_mesh.h"
#include "radiosity/visibility/coverage.h"

namespace radiosity {
namespace {

/// Parts of the patches that are summed by themselves, whatever the number of threads.
constexpr std::size_t kMostRowParts = 16;

}  // namespace

JointRow evaluated_row(const PatchMesh& mesh, const Visibility& visibility,
                       const std::vector<std::int32_t>& patches,
                       const EvaluatedRowOptions& options) {
  const WholeMesh whole(mesh);
  const Coverage coverage = find_coverage(whole.mesh(), plane_thickness(whole.mesh()));
  const ExchangeEvaluator evaluator(
      whole.mesh(), visibility, coverage,
      {.tolerance = options.tolerance, .seed = options.seed, .n_parts = whole.n_parts()});
  const std::size_t n_parts = std::min(kMostRowParts, patches.size());
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(mesh.size());
  std::vector<JointRow> parts(n_parts, {none, none});
  parallel_for(static_cast<std::ptrdiff_t>(n_parts), [&](std::ptrdiff_t part) {
    ExchangeEvaluator::Worker worker = evaluator.worker();
    for (auto k = static_cast<std::size_t>(part); k < patches.size(); k += n_parts) {
      options.progress.check();
      evaluator.visit_row(patches[k], worker, [&](Index column, const ExchangeArea& entry) {
        const Index j = evaluator.tree().order[column] % mesh.size();  // whichever image it is
        parts[part].factor[j] += entry.value;
        parts[part].error[j] += square(entry.error);
      });
    }
  });
  JointRow row{none, none};
  for (const JointRow& part : parts) {
    row.factor += part.factor;
    row.error += part.error;
  }
  double area = 0;
  for (const std::int32_t patch : patches) area += mesh.area[patch];
  return {row.factor / area, row.error.cwiseSqrt() / area};
}

}  // namespace radiosity

#include "radiosity/assembly/assembly_report.h"

#include <algorithm>

#include "radiosity/exchange/openings.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/visibility/visibility.h"

namespace radiosity {

AssemblyReport make_report(const Census& census, const Eigen::VectorXd& row_sums,
                           const std::vector<std::int32_t>& order, const std::vector<double>& areas,
                           const Eigen::VectorXd& covered) {
  AssemblyReport report;
  static_cast<Census&>(report) = census;
  report.row_sums.resize(row_sums.size());
  for (Index row = 0; row < row_sums.size(); ++row) {
    report.row_sums[order[row]] = row_sums[row] / areas[order[row]];
  }
  report.covered = covered;
  if (row_sums.size() == 0) return report;
  const Eigen::ArrayXd gap = (1 - covered.array() - report.row_sums.array()).abs();
  report.closure_mean = gap.mean();
  report.closure_max = gap.maxCoeff();
  return report;
}

void find_backs(const PatchMesh& mesh, const Visibility& visibility,
                const std::vector<std::int32_t>& order, const Eigen::VectorXd& row_sums,
                const std::vector<Index>& open_rows, std::uint64_t seed, AssemblyReport& report) {
  Eigen::VectorXd missing(mesh.size());
  for (Index row = 0; row < mesh.size(); ++row) {
    const std::int32_t i = order[row];
    missing[i] = 1 - report.covered[i] - row_sums[row] / mesh.area[i];
  }
  report.backs = shares_on_backs(mesh, visibility, missing, seed);
  report.open_patches.clear();
  for (const Index row : open_rows) {
    const std::int32_t i = order[row];
    if (report.backs[i] < missing[i]) report.open_patches.push_back(i);
  }
  std::sort(report.open_patches.begin(), report.open_patches.end());
  report.open_rows = static_cast<std::int64_t>(report.open_patches.size());
}

}  // namespace radiosity

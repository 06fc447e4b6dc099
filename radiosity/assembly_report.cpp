#include "radiosity/assembly_report.h"

namespace radiosity {

AssemblyReport make_report(const Census& census, const Eigen::VectorXd& row_sums,
                           const std::vector<std::int32_t>& order,
                           const std::vector<double>& areas, const Eigen::VectorXd& covered) {
  AssemblyReport report;
  report.facing = census.facing;
  report.visible = census.visible;
  report.hidden = census.hidden;
  report.undecided = census.undecided;
  report.partial = census.partial;
  report.rays = census.rays;
  report.known = census.known;
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

}  // namespace radiosity

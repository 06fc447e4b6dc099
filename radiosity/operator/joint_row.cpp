#include "radiosity/operator/joint_row.h"

namespace radiosity {
namespace {

double area_of(const Eigen::VectorXd& area, const std::vector<std::int32_t>& patches) {
  double sum = 0;
  for (const std::int32_t patch : patches) sum += area[patch];
  return sum;
}

}  // namespace

JointRow joint_row(const FactorRows& rows, const Eigen::VectorXd& area,
                   const std::vector<std::int32_t>& patches) {
  JointRow result{Eigen::VectorXd::Zero(area.size()), Eigen::VectorXd::Zero(area.size())};
  const double total = area_of(area, patches);
  for (const std::int32_t patch : patches) {
    const double share = area[patch] / total;
    result.factor += share * rows.row(patch);
    result.error += (share * rows.row_error(patch)).cwiseAbs2();
  }
  result.error = result.error.cwiseSqrt();
  return result;
}

JointRow joint_row(const Transport& transport, const std::vector<std::int32_t>& patches) {
  const Eigen::VectorXd& area = transport.area();
  if (transport.has_quick_rows()) return joint_row(rows_of(transport), area, patches);
  Eigen::VectorXd indicator = Eigen::VectorXd::Zero(area.size());
  for (const std::int32_t patch : patches) indicator[patch] = 1;
  const Eigen::VectorXd share = area / area_of(area, patches);
  return {transport.apply(indicator).col(0).cwiseProduct(share),
          transport.apply_error(indicator).col(0).cwiseProduct(share)};
}

}  // namespace radiosity

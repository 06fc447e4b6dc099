#include "radiosity/solve/quantity_summary.h"

#include <limits>

#include "radiosity/scene/patch_mesh.h"

namespace radiosity {
namespace {

QuantityShare empty_share(const std::string& surface, Index n_columns) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return {.surface = surface,
          .area = 0,
          .sum = Eigen::VectorXd::Zero(n_columns),
          .mean = Eigen::VectorXd::Zero(n_columns),
          .least = Eigen::VectorXd::Constant(n_columns, kInfinity),
          .greatest = Eigen::VectorXd::Constant(n_columns, -kInfinity)};
}

/// `mean` is the sum weighted by area until all patches are in.
void add_patch(QuantityShare& share, double area, const Eigen::VectorXd& value) {
  share.area += area;
  share.sum += value;
  share.mean += area * value;
  share.least = share.least.cwiseMin(value);
  share.greatest = share.greatest.cwiseMax(value);
}

}  // namespace

QuantitySummary summarize(const QuantityField& field, const PatchMesh& mesh) {
  const Index n_columns = field.values.cols();
  QuantitySummary summary = {field.info, field.unit, {}, empty_share("all", n_columns)};
  std::vector<QuantityShare> shares;
  for (const std::string& name : mesh.surface_names) {
    shares.push_back(empty_share(name, n_columns));
  }
  for (Index i = 0; i < mesh.size(); ++i) {
    const Eigen::VectorXd value = field.values.row(i).transpose();
    add_patch(shares[mesh.surface[i]], mesh.area[i], value);
    add_patch(summary.total, mesh.area[i], value);
  }
  for (QuantityShare& share : shares) {
    if (share.area == 0) continue;
    share.mean /= share.area;
    summary.surfaces.push_back(share);
  }
  summary.total.mean /= summary.total.area;
  return summary;
}

}  // namespace radiosity

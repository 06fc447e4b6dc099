#include "viewer/work/arrivals.h"

#include <algorithm>

#include "radiosity/solve/quantity.h"

namespace viewer {

using radiosity::Index;

std::vector<Arrival> arrivals(const radiosity::PatchMesh& mesh, const Eigen::VectorXd& row,
                              const Eigen::MatrixXd& radiosity, const radiosity::Bands& bands) {
  const auto n_surfaces = static_cast<Index>(mesh.surface_names.size());
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(n_surfaces, radiosity.cols());
  for (Index j = 0; j < mesh.size(); ++j) sums.row(mesh.surface[j]) += row[j] * radiosity.row(j);
  const Eigen::VectorXd means = radiosity::mean_over_bands(sums, bands.wavelengths);
  const double total = means.sum();
  std::vector<Arrival> result;
  for (Index s = 0; s < n_surfaces; ++s) {
    if (!(means[s] > 0)) continue;
    result.push_back({static_cast<std::int32_t>(s), sums.row(s), means[s] / total});
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const Arrival& a, const Arrival& b) { return a.share > b.share; });
  return result;
}

Eigen::MatrixXd arrival_density(const radiosity::PatchMesh& mesh, const Eigen::VectorXd& row,
                                const Eigen::MatrixXd& radiosity) {
  const Eigen::Map<const Eigen::VectorXd> area(mesh.area.data(), mesh.size());
  return row.cwiseQuotient(area).asDiagonal() * radiosity;
}

}  // namespace viewer

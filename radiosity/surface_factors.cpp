#include "radiosity/surface_factors.h"

namespace radiosity {

Eigen::VectorXd surface_areas(const PatchMesh& mesh) {
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(static_cast<Index>(mesh.surface_names.size()));
  for (Index i = 0; i < mesh.size(); ++i) areas[mesh.surface[i]] += mesh.area[i];
  return areas;
}

Eigen::MatrixXd surface_form_factors(const PatchMesh& mesh, const Transport& transport) {
  const auto n_surfaces = static_cast<Index>(mesh.surface_names.size());
  Eigen::MatrixXd members = Eigen::MatrixXd::Zero(mesh.size(), n_surfaces);
  for (Index i = 0; i < mesh.size(); ++i) members(i, mesh.surface[i]) = 1;
  const Eigen::MatrixXd reached = transport.apply(members);
  Eigen::MatrixXd factors = Eigen::MatrixXd::Zero(n_surfaces, n_surfaces);
  for (Index i = 0; i < mesh.size(); ++i) {
    factors.row(mesh.surface[i]) += mesh.area[i] * reached.row(i);
  }
  const Eigen::VectorXd areas = surface_areas(mesh);
  for (Index s = 0; s < n_surfaces; ++s) {
    if (areas[s] > 0) factors.row(s) /= areas[s];
  }
  return factors;
}

}  // namespace radiosity

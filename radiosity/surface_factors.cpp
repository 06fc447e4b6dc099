#include "radiosity/surface_factors.h"

namespace radiosity {
namespace {

Eigen::MatrixXd divide_by_areas(const PatchMesh& mesh, Eigen::MatrixXd exchange) {
  const Eigen::VectorXd areas = surface_areas(mesh);
  for (Index s = 0; s < areas.size(); ++s) {
    if (areas[s] > 0) exchange.row(s) /= areas[s];
  }
  return exchange;
}

}  // namespace

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
  Eigen::MatrixXd exchange = Eigen::MatrixXd::Zero(n_surfaces, n_surfaces);
  for (Index i = 0; i < mesh.size(); ++i) {
    exchange.row(mesh.surface[i]) += mesh.area[i] * reached.row(i);
  }
  return divide_by_areas(mesh, exchange);
}

SurfaceFactorSums::SurfaceFactorSums(const PatchMesh& mesh)
    : mesh_(mesh),
      exchange_(Eigen::MatrixXd::Zero(static_cast<Index>(mesh.surface_names.size()),
                                      static_cast<Index>(mesh.surface_names.size()))) {}

void SurfaceFactorSums::add_row(Index i, const Eigen::VectorXd& row) {
  const std::int32_t from = mesh_.surface[i];
  for (Index j = 0; j < row.size(); ++j) {
    exchange_(from, mesh_.surface[j]) += mesh_.area[i] * row[j];
  }
}

Eigen::MatrixXd SurfaceFactorSums::factors() const { return divide_by_areas(mesh_, exchange_); }

}  // namespace radiosity

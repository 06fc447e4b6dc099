#include "radiosity/assembly/dense_transport.h"

#include <cmath>
#include <utility>

#include "radiosity/assembly/exchange_assembly.h"
#include "radiosity/assembly/row_exchange.h"
#include "radiosity/visibility/cluster_tree.h"

namespace radiosity {

DenseTransport::DenseTransport(Parts parts)
    : order_(std::move(parts.order)),
      tiles_(std::move(parts.tiles)),
      area_(std::move(parts.area)),
      report_(std::move(parts.report)) {
  const Eigen::MatrixXd inverse_area = order_.to_rows(area_.cwiseInverse());
  // ‖ΔF̂‖_F² = Σ σ_ij² / (A_i A_j)
  error_ = std::sqrt(inverse_area.col(0).dot(tiles_.error_product(inverse_area).col(0)));
}

Eigen::MatrixXd DenseTransport::apply(const Eigen::MatrixXd& radiosity) const {
  const CountedProduct counted(tiles_.ranks());
  Eigen::MatrixXd result = order_.to_patches(tiles_.product(order_.to_rows(radiosity)));
  result.array().colwise() /= area_.array();
  return result;
}

Eigen::MatrixXd DenseTransport::apply_error(const Eigen::MatrixXd& radiosity) const {
  const Eigen::MatrixXd squares = order_.to_rows(radiosity.cwiseAbs2());
  Eigen::MatrixXd result = order_.to_patches(tiles_.error_product(squares)).cwiseSqrt();
  result.array().colwise() /= area_.array();
  return result;
}

Eigen::VectorXd DenseTransport::row(Index i) const {
  return order_.to_patches(tiles_.row(order_.row(i))) / area_[i];
}

Eigen::VectorXd DenseTransport::row_error(Index i) const {
  return order_.to_patches(tiles_.row_error(order_.row(i))) / area_[i];
}

ExchangeArea DenseTransport::pair(Index i, Index j) const {
  return tiles_.entry(order_.row(i), order_.row(j));
}

void DenseTransport::visit_share(Index block, const Progress& progress,
                                 const Visitor& visit) const {
  visit_row_share(tiles_, order_, area_, block, progress, visit);
}

void DenseTransport::complete(Index block, Eigen::MatrixXd& values) const {
  complete_rows(*tiles_.ranks(), block, values);
}

std::unique_ptr<DenseTransport> dense_transport_of(const PatchMesh& mesh, const FactorRows& rows,
                                                   const Eigen::VectorXd& row_sums,
                                                   AssemblyReport report,
                                                   const Progress& progress) {
  TileLayout layout =
      tile_layout(make_cluster_tree(centered(mesh), kTileSize, plane_thickness(mesh)));
  const PatchOrder order(layout.order);
  ExchangeMatrix tiles(layout.strips);
  const auto n = static_cast<double>(mesh.size());
  for (Index i = 0; i < mesh.size(); ++i) {
    progress.check();
    if (progress.report) progress.report("reading form factors", static_cast<double>(i), n, "rows");
    tiles.set_row(order.row(i), mesh.area[i] * order.to_rows(rows.row(i)),
                  mesh.area[i] * order.to_rows(rows.row_error(i)));
  }
  const Eigen::VectorXd area = Eigen::Map<const Eigen::VectorXd>(mesh.area.data(), mesh.size());
  tiles.set_row_sums(order.to_rows(area.cwiseProduct(row_sums)));
  return std::make_unique<DenseTransport>(
      DenseTransport::Parts{std::move(layout.order), std::move(tiles), area, std::move(report)});
}

}  // namespace radiosity

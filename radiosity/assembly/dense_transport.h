#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "radiosity/assembly/exchange_matrix.h"
#include "radiosity/base/geometry.h"
#include "radiosity/base/progress.h"
#include "radiosity/operator/factor_rows.h"
#include "radiosity/operator/patch_order.h"
#include "radiosity/operator/shared_rows.h"
#include "radiosity/operator/transport.h"
#include "radiosity/scene/patch_mesh.h"

namespace radiosity {

/// The radiosity transport operator with all form factors in memory: of this process, or of several
/// ranks, which then call all methods together.
class DenseTransport final : public Transport, public FactorRows, public SharedRows {
 public:
  /// All that it consists of.
  struct Parts {
    std::vector<std::int32_t> order;  ///< patch of each row of the tiles
    ExchangeMatrix tiles;
    Eigen::VectorXd area;  ///< m², in the order of the patches
    AssemblyReport report;
  };
  explicit DenseTransport(Parts parts);

  [[nodiscard]] Index size() const override { return area_.size(); }
  [[nodiscard]] const Eigen::VectorXd& area() const override { return area_; }
  [[nodiscard]] Eigen::MatrixXd apply(const Eigen::MatrixXd& radiosity) const override;
  [[nodiscard]] Eigen::MatrixXd apply_error(const Eigen::MatrixXd& radiosity) const override;
  [[nodiscard]] double error() const override { return error_; }
  [[nodiscard]] std::size_t bytes() const override { return tiles_.bytes(); }
  [[nodiscard]] const AssemblyReport& report() const override { return report_; }
  [[nodiscard]] const FactorRows* rows() const override { return this; }
  [[nodiscard]] bool has_quick_rows() const override { return tiles_.ranks() == nullptr; }
  [[nodiscard]] const SharedRows* shared_rows() const override {
    return tiles_.ranks() != nullptr ? this : nullptr;
  }

  [[nodiscard]] Eigen::VectorXd row(Index i) const override;
  [[nodiscard]] Eigen::VectorXd row_error(Index i) const override;
  [[nodiscard]] ExchangeArea pair(Index i, Index j) const override;

  void visit_share(Index block, const Progress& progress, const Visitor& visit) const override;
  void complete(Index block, Eigen::MatrixXd& values) const override;

 private:
  PatchOrder order_;  // of the tiles' rows
  ExchangeMatrix tiles_;
  Eigen::VectorXd area_;
  AssemblyReport report_;
  double error_ = 0;
};

/// A dense operator of form factors that are there already: of each pair the entry of the row that
/// comes first in a tree of the patches. `row_sums` are Σ_j F_ij, n, as `apply` shall have them.
/// Throws Interrupted, and what `rows` throw.
std::unique_ptr<DenseTransport> dense_transport_of(const PatchMesh& mesh, const FactorRows& rows,
                                                   const Eigen::VectorXd& row_sums,
                                                   AssemblyReport report,
                                                   const Progress& progress = {});

}  // namespace radiosity

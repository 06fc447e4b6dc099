#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "radiosity/assembly/transport_options.h"
#include "radiosity/base/geometry.h"
#include "radiosity/base/ranks.h"
#include "radiosity/compressed/compressed_blocks.h"
#include "radiosity/operator/factor_rows.h"
#include "radiosity/operator/patch_order.h"
#include "radiosity/operator/transport.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/visibility/visibility.h"

namespace radiosity {

/// The radiosity transport operator as far and near blocks (CompressedBlocks): memory and time
/// hardly grow faster than the number of patches. Its error is verified against exact rows.
class CompressedTransport final : public Transport, public FactorRows, public PairSums {
 public:
  /// All that it consists of.
  struct Parts {
    std::vector<std::int32_t> order;  ///< patches in the tree's order
    CompressedBlocks blocks;
    Eigen::VectorXd area;  ///< m², in the order of the patches
    /// Closes the rows: d_ab² (μ_i + μ_j) is added to each density, n, in the tree's order; empty
    /// if nothing is.
    Eigen::VectorXd multipliers = {};
    /// What the exchange with a part of the scene lacks: r_i is added to the sum of G_ij over its
    /// patches j by the symmetric change r vᵀ + v rᵀ - (Σ_s r) v vᵀ, with v its patches' areas over
    /// their sum.
    struct Source {
      std::vector<std::int32_t> patches;  ///< in rising order
      Eigen::VectorXd lacking;            ///< r, m², n
    };
    std::vector<Source> sources = {};
    double error_scale = 1;      ///< of the blocks' errors
    AssemblyReport report = {};  ///< with its `compression`
    Ranks* ranks = nullptr;      ///< that have the same parts, and share the products
  };
  explicit CompressedTransport(Parts parts);

  [[nodiscard]] Index size() const override { return parts_.area.size(); }
  [[nodiscard]] const Eigen::VectorXd& area() const override { return parts_.area; }
  [[nodiscard]] Eigen::MatrixXd apply(const Eigen::MatrixXd& radiosity) const override;
  /// Errors are taken as common to a block.
  [[nodiscard]] Eigen::MatrixXd apply_error(const Eigen::MatrixXd& radiosity) const override;
  /// Twice the largest standard error of a row of F 1: what the norm of a symmetric matrix of
  /// independent errors comes to. (Bandeira & van Handel 2016)
  [[nodiscard]] double error() const override;
  [[nodiscard]] std::size_t bytes() const override;
  [[nodiscard]] const AssemblyReport& report() const override { return parts_.report; }
  /// A row takes a product.
  [[nodiscard]] const FactorRows* rows() const override { return this; }
  [[nodiscard]] bool has_quick_rows() const override { return false; }
  [[nodiscard]] const PairSums* pair_sums() const override { return this; }

  /// What it consists of, but for the blocks, which the matrix has.
  [[nodiscard]] const Parts& parts() const { return parts_; }
  [[nodiscard]] const CompressedMatrix& matrix() const { return matrix_; }
  /// Of the matrix's rows.
  [[nodiscard]] const PatchOrder& order() const { return order_; }
  /// Adds to the blocks for light: to what is lacking of the source with these patches, or one
  /// more.
  void add_source(Parts::Source source);
  /// Replaces what closes the rows.
  void set_multipliers(Eigen::VectorXd multipliers) { parts_.multipliers = std::move(multipliers); }
  void set_report(AssemblyReport report) { parts_.report = std::move(report); }

  [[nodiscard]] Eigen::VectorXd row(Index i) const override;
  [[nodiscard]] Eigen::VectorXd row_error(Index i) const override;
  [[nodiscard]] ExchangeArea pair(Index i, Index j) const override;
  [[nodiscard]] Eigen::MatrixXd sums(const PatchMesh& mesh, const Eigen::MatrixXd& x,
                                     const Weight& weight) const override;
  [[nodiscard]] Eigen::VectorXd squares_of_groups(const NeighborGroups& groups,
                                                  const Eigen::VectorXd& x,
                                                  const Eigen::VectorXd& weight,
                                                  const Progress& progress) const override;

 private:
  friend class CompressedAssembly;
  void add_lacking(const Eigen::MatrixXd& x, Eigen::MatrixXd& result) const;
  [[nodiscard]] double lacking_density(const Parts::Source& source, Index i, Index j) const;
  [[nodiscard]] Eigen::VectorXd row_of_column(Index i, const Eigen::VectorXd& column) const;

  Parts parts_;
  PatchOrder order_;  // of the tree
  CompressedMatrix matrix_;
};

}  // namespace radiosity

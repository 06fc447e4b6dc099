#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/operator/census.h"
#include "radiosity/operator/compression_report.h"
#include "radiosity/operator/factor_rows.h"
#include "radiosity/operator/pair_sums.h"
#include "radiosity/operator/shared_rows.h"

namespace radiosity {

/// What the assembly of the exchange areas did and how good it is.
struct AssemblyReport : Census {
  double seconds = 0;          ///< wall time of the assembly
  bool closed = false;         ///< the scene was taken as closed
  Eigen::VectorXd row_sums;    ///< Σ_j F_ij before any correction, n_patches
  std::int64_t open_rows = 0;  ///< closed scenes: rows further from 1 than errors and backs explain
  std::vector<std::int32_t>
      open_patches;  ///< these, increasing; of a file none, for it has no list
  /// Share of each patch that lies on a solid's face and looks into it, n_patches: nothing leaves
  /// it and nothing reaches it, so that a row of a closed scene sums to 1 less this.
  Eigen::VectorXd covered;
  /// Share of each patch's power that meets the backs of one-sided surfaces, n_patches, by rays.
  Eigen::VectorXd backs;
  std::optional<CompressionReport> compression = {};  ///< of a compressed operator
  double closure_mean = 0;  ///< mean |1 - covered - Σ_j F_ij|, before any correction
  double closure_max = 0;   ///< max |1 - covered - Σ_j F_ij|, before any correction
};

/// The radiosity transport operator F of n patches, F_ij = G_ij / A_i with the exchange area
/// G_ij = A_i F_ij = G_ji stored once per pair, so that reciprocity is exact.
class Transport {
 public:
  virtual ~Transport() = default;

  /// Number of patches n.
  [[nodiscard]] virtual Index size() const = 0;
  /// Patch areas, m², n.
  [[nodiscard]] virtual const Eigen::VectorXd& area() const = 0;
  /// Irradiance H = F B, W/m², n x k, of the radiosity B, n x k, for all k columns at once.
  [[nodiscard]] virtual Eigen::MatrixXd apply(const Eigen::MatrixXd& radiosity) const = 0;
  /// One standard error of each patch's irradiance F B caused by the entries' errors, for
  /// independent entries: sqrt(Σ_j (σ_ij B_j)²), n x k.
  [[nodiscard]] virtual Eigen::MatrixXd apply_error(const Eigen::MatrixXd& radiosity) const = 0;
  /// Bound on ‖ΔF̂‖₂, F̂ = A^-½ G A^-½, from the entries' standard errors (Frobenius norm: one
  /// sigma). Dimensionless.
  [[nodiscard]] virtual double error() const = 0;
  /// Memory held by the operator, bytes.
  [[nodiscard]] virtual std::size_t bytes() const = 0;
  /// How the operator was made.
  [[nodiscard]] virtual const AssemblyReport& report() const = 0;
  /// Its rows, if it can tell them.
  [[nodiscard]] virtual const FactorRows* rows() const { return nullptr; }
  /// Whether a row takes much less than a product.
  [[nodiscard]] virtual bool has_quick_rows() const { return rows() != nullptr; }
  /// Its rows, if several ranks have them.
  [[nodiscard]] virtual const SharedRows* shared_rows() const { return nullptr; }
  /// Sums over its pairs, if it can tell them without rows.
  [[nodiscard]] virtual const PairSums* pair_sums() const { return nullptr; }
};

/// For methods that need rows. Throws SolveError if the operator does not keep them.
const FactorRows& rows_of(const Transport& transport);
/// For methods that need all of them, over and over. Throws SolveError if each takes a product.
const FactorRows& quick_rows_of(const Transport& transport);

}  // namespace radiosity

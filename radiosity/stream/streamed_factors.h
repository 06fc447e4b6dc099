#pragma once

#include <cstdint>
#include <optional>

#include "radiosity/assembly/transport_options.h"
#include "radiosity/base/fingerprint.h"
#include "radiosity/base/geometry.h"
#include "radiosity/base/progress.h"
#include "radiosity/base/ranks.h"
#include "radiosity/operator/transport.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/stream/row_stream.h"
#include "radiosity/stream/stored_balance.h"
#include "radiosity/visibility/visibility.h"

namespace radiosity {

struct StreamOptions {
  double tolerance = 1e-3;            ///< relative error asked of the form factors, > 0
  Closed closed = Closed::automatic;  ///< whether all row sums must be 1
  std::uint64_t seed = 0;             ///< of the visibility samples
  double min_factor = 0;    ///< pairs with both form factors below it are dropped, in [0, 1)
  std::size_t buffers = 0;  ///< bytes for buffers; the result does not depend on them
  /// The processes that make the tiles together, for the first one's store; the others call
  /// assist_streamed_factors() meanwhile. Null: this one alone. The result has the same bits.
  Ranks* ranks = nullptr;
  Progress progress{};
};

/// What dropping the smallest pairs did.
struct DroppedFactors {
  std::int64_t entries = 0;          ///< of F
  double share = 0;                  ///< Σ dropped G / Σ G
  double largest_row_share = 0;      ///< the same within one row, at most
  std::int64_t unbalanced_rows = 0;  ///< rows whose sum could not be kept
};

/// Identifies a computation: a hash of the patches and of all options that change the result.
Fingerprint stream_fingerprint(const PatchMesh& mesh, const StreamOptions& options);

/// What the assembly of the tiles takes.
TransportOptions assembly_options(const StreamOptions& options);

/// Form factors of any number of patches: the exchange areas go to a tile store as they are
/// computed and come back row by row, in float64. Same input, same bits, at any number of threads,
/// however little the memory and however often the work was stopped and resumed. The row sums are
/// kept or, in a closed scene, made 1.
class StreamedFactors {
 public:
  /// Computes the tiles that the store has not, then the corrections. `mesh` and `store` must live
  /// as long as this. Throws OutputError (a full disk, say) and Interrupted; the store then keeps
  /// what is done.
  StreamedFactors(const PatchMesh& mesh, const Visibility& visibility, const StreamOptions& options,
                  TileStore& store);
  StreamedFactors(const StreamedFactors&) = delete;
  StreamedFactors& operator=(const StreamedFactors&) = delete;

  [[nodiscard]] const AssemblyReport& report() const { return report_; }
  [[nodiscard]] const DroppedFactors& dropped() const { return dropped_; }
  /// Size of the work file, bytes.
  [[nodiscard]] std::uint64_t bytes() const { return store_.bytes(); }
  /// Visits the rows in the order of the patches.
  void for_each_row(const RowVisitor& visit) const;

 private:
  [[nodiscard]] Eigen::VectorXd areas_of_rows() const;
  RowSums close(const Visibility& visibility, const Eigen::VectorXd& row_sums,
                const Eigen::VectorXd& areas);
  void drop(RowSums& sums);
  void balance(RowSums& sums);

  const PatchMesh& mesh_;
  StreamOptions options_;
  TileStore& store_;
  AssemblyReport report_;
  DroppedFactors dropped_;
  std::optional<StoredClosure> closure_;
  std::optional<StoredBalance> balance_;
};

/// What the other ranks do while the first makes StreamedFactors: their share of the tiles.
void assist_streamed_factors(const PatchMesh& mesh, const Visibility& visibility,
                             const StreamOptions& options);

/// The standard errors of one row, n.
Eigen::VectorXd row_error_of(const StreamedFactors& factors, Index row);

}  // namespace radiosity

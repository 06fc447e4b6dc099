#pragma once

#include <cstddef>
#include <vector>

#include "radiosity/assembly/closure.h"
#include "radiosity/base/geometry.h"
#include "radiosity/stream/tile_store.h"

namespace radiosity {

/// The uncertain entries of a tile store, for the closure correction. The file is never changed:
/// what the rounds of the correction did to an entry follows from their factors, which are kept,
/// and is worked out anew whenever it is read. So memory need not grow with the number of entries.
class StoredClosure final : public UncertainExchange {
 public:
  /// Keeps the uncertain entries in memory if they fit into `memory` bytes, else reads them from
  /// the file each time. The result does not depend on it.
  StoredClosure(const TileStore& store, std::size_t memory);

  [[nodiscard]] Index size() const override { return strips().n_rows(); }
  [[nodiscard]] Eigen::VectorXd weighted_sums(const Eigen::VectorXd& x) const override;
  void adjust(const Eigen::VectorXd& factors) override;
  [[nodiscard]] Eigen::VectorXd row_sums() const override;
  [[nodiscard]] double rounding() const override;
  [[nodiscard]] Eigen::VectorXd row_variances() const override;
  [[nodiscard]] Eigen::VectorXd row_errors() const override;
  void freeze(const Eigen::VectorXd& mask) override;

  /// Gives back the memory for the entries.
  void release_memory();
  [[nodiscard]] const Strips& strips() const { return store_.layout().strips; }
  /// A tile as the correction has left it.
  [[nodiscard]] ExchangeTile tile(Index row_strip, Index column_strip) const;

 private:
  /// Entries of a tile with their present values.
  struct Part : TileStore::UncertainPart {
    std::vector<bool> is_fixed{};  ///< per entry: may not change
  };

  void load();
  [[nodiscard]] bool is_loaded() const { return !parts_.empty(); }
  template <typename Change>
  void change_loaded(const Change& change);
  void freeze_masked(Part& part, Index row_strip, Index column_strip) const;
  void advance(Part& part, Index row_strip, Index column_strip,
               const Eigen::VectorXd& factors) const;
  [[nodiscard]] Part read(Index row_strip, Index column_strip) const;
  [[nodiscard]] Eigen::VectorXd uncertain_sums() const;
  template <typename Term>
  [[nodiscard]] Eigen::VectorXd sum_entries(const Eigen::VectorXd& x, const Term& term) const;

  const TileStore& store_;
  Eigen::VectorXd mask_;
  Eigen::VectorXd certain_sums_;         // Σ_j G_ij over certain entries, m², once frozen
  std::vector<Eigen::VectorXd> rounds_;  // factors of each
  std::vector<Part> parts_;              // per tile if loaded, else empty
};

}  // namespace radiosity

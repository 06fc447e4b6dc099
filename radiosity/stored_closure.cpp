#include "radiosity/stored_closure.h"

#include <cmath>

#include "radiosity/tile_sum.h"

namespace radiosity {
namespace {

constexpr double kRounding = 1e-14;
/// Beyond this many rows the rounding of the sums themselves is more.
constexpr double kExactRows = 512;

double variance(const RecordedEntry& entry) {
  return static_cast<double>(entry.error) * entry.error;
}

}  // namespace

StoredClosure::StoredClosure(const TileStore& store, std::size_t memory)
    : store_(store), mask_(Eigen::VectorXd::Ones(size())) {
  const std::size_t needed =
      store.n_uncertain() * sizeof(RecordedEntry) + strips().n_tiles() * (sizeof(std::int64_t) + 1);
  if (needed <= memory) load();
}

void StoredClosure::load() {
  entries_.reserve(store_.n_uncertain());
  starts_ = {0};
  for (Index column_strip = 0; column_strip < strips().size(); ++column_strip) {
    for (Index row_strip = 0; row_strip <= column_strip; ++row_strip) {
      const TileStore::UncertainPart part = store_.uncertain_part(row_strip, column_strip);
      entries_.insert(entries_.end(), part.entries.begin(), part.entries.end());
      starts_.push_back(static_cast<std::int64_t>(entries_.size()));
      is_zero_.push_back(part.is_zero);
    }
  }
  is_loaded_ = true;
}

void StoredClosure::release_memory() {
  is_loaded_ = false;
  entries_ = {};
  starts_ = {};
  is_zero_ = {};
}

/// Calls visit(entry, i, j, state) for the uncertain entries of a tile in their order.
template <typename Visit>
void StoredClosure::visit_tile(Index row_strip, Index column_strip, const Visit& visit) const {
  const Index first_row = strips().begin(row_strip);
  const Index first_column = strips().begin(column_strip);
  const auto visit_all = [&](std::span<const RecordedEntry> entries, bool is_zero_tile) {
    for (const RecordedEntry& entry : entries) {
      const Index i = first_row + entry.row;
      const Index j = first_column + entry.column;
      visit(entry, i, j, replay(entry, i, j, is_zero_tile));
    }
  };
  if (is_loaded_) {
    const Index t = Strips::tile(row_strip, column_strip);
    visit_all(std::span(entries_).subspan(starts_[t], starts_[t + 1] - starts_[t]), is_zero_[t]);
  } else {
    const TileStore::UncertainPart part = store_.uncertain_part(row_strip, column_strip);
    visit_all(part.entries, part.is_zero);
  }
}

StoredClosure::State StoredClosure::replay(const RecordedEntry& entry, Index i, Index j,
                                           bool is_zero_tile) const {
  State state{entry.value, entry.error > 0 && mask_[i] != 0 && mask_[j] != 0};
  // As in ExchangeTiles, the zeros of a tile without anything else stay what they are.
  if (is_zero_tile && !rounds_.empty()) state.is_free = false;
  for (const Eigen::VectorXd& factors : rounds_) {
    if (!state.is_free) break;
    const double value = state.value + variance(entry) * (factors[i] + factors[j]);
    state = {std::max(value, 0.0), value >= 0};
  }
  return state;
}

/// Σ_j term(entry, state) x_j over the uncertain entries.
template <typename Term>
Eigen::VectorXd StoredClosure::sum_entries(const Eigen::VectorXd& x, const Term& term) const {
  const auto add_tile = [&](Index row_strip, Index column_strip, const Eigen::MatrixXd& block,
                            Eigen::MatrixXd& sum) {
    const bool is_diagonal = row_strip == column_strip;
    visit_tile(row_strip, column_strip,
               [&](const RecordedEntry& entry, Index i, Index j, const State& state) {
                 const double factor = term(entry, state);
                 sum(i, 0) += factor * block(j, 0);
                 if (!is_diagonal) sum(j, 0) += factor * block(i, 0);
               });
  };
  return sum_over_tiles(strips(), x, add_tile).col(0);
}

Eigen::VectorXd StoredClosure::weighted_sums(const Eigen::VectorXd& x) const {
  return sum_entries(x, [](const RecordedEntry& entry, const State& state) {
    return state.is_free ? variance(entry) : 0.0;
  });
}

Eigen::VectorXd StoredClosure::row_variances() const {
  return sum_entries(Eigen::VectorXd::Ones(size()),
                     [](const RecordedEntry& entry, const State&) { return variance(entry); });
}

Eigen::VectorXd StoredClosure::row_sums() const {
  return store_.totals().row_sums() +
         sum_entries(Eigen::VectorXd::Ones(size()), [](const RecordedEntry& entry, const State& s) {
           return s.value - entry.value;
         });
}

double StoredClosure::rounding() const {
  return kRounding * std::sqrt(std::max(1.0, static_cast<double>(size()) / kExactRows));
}

ExchangeTile StoredClosure::tile(Index row_strip, Index column_strip) const {
  ExchangeTile result = store_.tile(row_strip, column_strip);
  if (rounds_.empty() || result.uncertain.empty()) return result;
  visit_tile(row_strip, column_strip,
             [&](const RecordedEntry& entry, Index, Index, const State& state) {
               result.values(entry.row, entry.column) = state.value;
             });
  return result;
}

}  // namespace radiosity

#include "radiosity/stream/stored_closure.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "radiosity/assembly/tile_sum.h"
#include "radiosity/base/parallel.h"

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
  const std::size_t needed = store.n_uncertain() * sizeof(RecordedEntry) + store.n_uncertain() / 8 +
                             strips().n_tiles() * sizeof(Part);
  if (needed <= memory) load();
}

void StoredClosure::load() {
  std::vector<Part> parts(strips().n_tiles());
  parallel_for(strips().size(), [&](Index column_strip) {
    for (Index row_strip = 0; row_strip <= column_strip; ++row_strip) {
      parts[Strips::tile(row_strip, column_strip)] = read(row_strip, column_strip);
    }
  });
  parts_ = std::move(parts);
}

void StoredClosure::release_memory() { parts_ = {}; }

template <typename Change>
void StoredClosure::change_loaded(const Change& change) {
  if (!is_loaded()) return;
  parallel_for(strips().size(), [&](Index column_strip) {
    for (Index row_strip = 0; row_strip <= column_strip; ++row_strip) {
      change(parts_[Strips::tile(row_strip, column_strip)], row_strip, column_strip);
    }
  });
}

void StoredClosure::freeze(const Eigen::VectorXd& mask) {
  certain_sums_ = store_.totals().row_sums() - uncertain_sums();
  mask_ = mask;
  change_loaded([this](Part& part, Index row_strip, Index column_strip) {
    freeze_masked(part, row_strip, column_strip);
  });
}

void StoredClosure::freeze_masked(Part& part, Index row_strip, Index column_strip) const {
  const auto row_mask = mask_.segment(strips().begin(row_strip), strips().rows(row_strip));
  const auto column_mask = mask_.segment(strips().begin(column_strip), strips().rows(column_strip));
  part.is_fixed.resize(part.entries.size());
  for (std::size_t k = 0; k < part.entries.size(); ++k) {
    const RecordedEntry& entry = part.entries[k];
    part.is_fixed[k] = row_mask[entry.row] == 0 || column_mask[entry.column] == 0;
  }
}

void StoredClosure::adjust(const Eigen::VectorXd& factors) {
  rounds_.push_back(factors);
  change_loaded([&](Part& part, Index row_strip, Index column_strip) {
    advance(part, row_strip, column_strip, factors);
  });
}

/// One round of the correction.
void StoredClosure::advance(Part& part, Index row_strip, Index column_strip,
                            const Eigen::VectorXd& factors) const {
  const auto row_factors = factors.segment(strips().begin(row_strip), strips().rows(row_strip));
  const auto column_factors =
      factors.segment(strips().begin(column_strip), strips().rows(column_strip));
  for (std::size_t k = 0; k < part.entries.size(); ++k) {
    if (part.is_fixed[k]) continue;
    RecordedEntry& entry = part.entries[k];
    // As in ExchangeMatrix, the zeros of a tile without anything else stay what they are.
    const double change = row_factors[entry.row] + column_factors[entry.column];
    part.is_fixed[k] = part.is_zero || !change_entry(entry.value, entry.error, change);
  }
}

/// The entries of a tile from the file, brought up to date.
StoredClosure::Part StoredClosure::read(Index row_strip, Index column_strip) const {
  Part part{store_.uncertain_part(row_strip, column_strip)};
  freeze_masked(part, row_strip, column_strip);
  for (const Eigen::VectorXd& factors : rounds_) advance(part, row_strip, column_strip, factors);
  return part;
}

/// Σ_j term(part, k) x_j over the uncertain entries.
template <typename Term>
Eigen::VectorXd StoredClosure::sum_entries(const Eigen::VectorXd& x, const Term& term) const {
  const auto add_tile = [&](Index row_strip, Index column_strip, const Eigen::MatrixXd& block,
                            Eigen::MatrixXd& sum) {
    const Part unloaded = is_loaded() ? Part() : read(row_strip, column_strip);
    const Part& part = is_loaded() ? parts_[Strips::tile(row_strip, column_strip)] : unloaded;
    const Index first_row = strips().begin(row_strip);
    const Index first_column = strips().begin(column_strip);
    const double* in = block.data();
    double* out = sum.data();
    for (std::size_t k = 0; k < part.entries.size(); ++k) {
      const RecordedEntry& entry = part.entries[k];
      const double factor = term(part, k);
      const Index i = first_row + entry.row;
      const Index j = first_column + entry.column;
      out[i] += factor * in[j];
      if (row_strip != column_strip) out[j] += factor * in[i];
    }
  };
  return sum_over_tiles(strips(), x, add_tile).col(0);
}

Eigen::VectorXd StoredClosure::weighted_sums(const Eigen::VectorXd& x) const {
  return sum_entries(x, [](const Part& part, std::size_t k) {
    return part.is_fixed[k] ? 0.0 : variance(part.entries[k]);
  });
}

Eigen::VectorXd StoredClosure::row_variances() const {
  return sum_entries(Eigen::VectorXd::Ones(size()),
                     [](const Part& part, std::size_t k) { return variance(part.entries[k]); });
}

Eigen::VectorXd StoredClosure::row_errors() const {
  return sum_entries(Eigen::VectorXd::Ones(size()), [](const Part& part, std::size_t k) {
    return static_cast<double>(part.entries[k].error);
  });
}

/// Σ_j G_ij over the uncertain entries as they are.
Eigen::VectorXd StoredClosure::uncertain_sums() const {
  return sum_entries(Eigen::VectorXd::Ones(size()),
                     [](const Part& part, std::size_t k) { return part.entries[k].value; });
}

Eigen::VectorXd StoredClosure::row_sums() const { return certain_sums_ + uncertain_sums(); }

double StoredClosure::rounding() const {
  return kRounding * std::sqrt(std::max(1.0, static_cast<double>(size()) / kExactRows));
}

ExchangeTile StoredClosure::tile(Index row_strip, Index column_strip) const {
  ExchangeTile result = store_.tile(row_strip, column_strip);
  if (rounds_.empty() || result.uncertain.empty()) return result;
  for (const RecordedEntry& entry : read(row_strip, column_strip).entries) {
    result.values(entry.row, entry.column) = entry.value;
  }
  return result;
}

}  // namespace radiosity

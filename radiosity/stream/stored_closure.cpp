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
  const std::size_t needed =
      store.n_uncertain() * sizeof(RecordedEntry) + strips().n_tiles() * sizeof(Part);
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
  certain_sums_ = store_.totals().row_sums() -
                  sum_entries(Eigen::VectorXd::Ones(size()),
                              [](const RecordedEntry& entry) { return entry.value; });
  mask_ = mask;
  change_loaded([this](Part& part, Index row_strip, Index column_strip) {
    freeze_masked(part, row_strip, column_strip);
  });
}

void StoredClosure::freeze_masked(Part& part, Index row_strip, Index column_strip) const {
  const auto row_mask = mask_.segment(strips().begin(row_strip), strips().rows(row_strip));
  const auto column_mask = mask_.segment(strips().begin(column_strip), strips().rows(column_strip));
  for (RecordedEntry& entry : part.entries) {
    if (row_mask[entry.row] == 0 || column_mask[entry.column] == 0) entry.error = -entry.error;
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
  for (RecordedEntry& entry : part.entries) {
    if (entry.error <= 0) continue;
    const double change = variance(entry) * (row_factors[entry.row] + column_factors[entry.column]);
    const double value = entry.value + change;
    // As in ExchangeTiles, the zeros of a tile without anything else stay what they are.
    if (value < 0 || part.is_zero) entry.error = -entry.error;
    if (!part.is_zero) entry.value = std::max(value, 0.0);
  }
}

/// The entries of a tile from the file, brought up to date.
StoredClosure::Part StoredClosure::read(Index row_strip, Index column_strip) const {
  Part part = store_.uncertain_part(row_strip, column_strip);
  freeze_masked(part, row_strip, column_strip);
  for (const Eigen::VectorXd& factors : rounds_) advance(part, row_strip, column_strip, factors);
  return part;
}

/// Σ_j term(entry) x_j over the uncertain entries.
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
    for (const RecordedEntry& entry : part.entries) {
      const double factor = term(entry);
      const Index i = first_row + entry.row;
      const Index j = first_column + entry.column;
      out[i] += factor * in[j];
      if (row_strip != column_strip) out[j] += factor * in[i];
    }
  };
  return sum_over_tiles(strips(), x, add_tile).col(0);
}

Eigen::VectorXd StoredClosure::weighted_sums(const Eigen::VectorXd& x) const {
  return sum_entries(
      x, [](const RecordedEntry& entry) { return entry.error > 0 ? variance(entry) : 0.0; });
}

Eigen::VectorXd StoredClosure::row_variances() const {
  return sum_entries(Eigen::VectorXd::Ones(size()), variance);
}

Eigen::VectorXd StoredClosure::row_errors() const {
  return sum_entries(Eigen::VectorXd::Ones(size()),
                     [](const RecordedEntry& entry) { return std::abs(double{entry.error}); });
}

Eigen::VectorXd StoredClosure::row_sums() const {
  return certain_sums_ + sum_entries(Eigen::VectorXd::Ones(size()),
                                     [](const RecordedEntry& entry) { return entry.value; });
}

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

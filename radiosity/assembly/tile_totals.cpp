#include "radiosity/assembly/tile_totals.h"

#include <array>
#include <cmath>

namespace radiosity {
namespace {

/// Sums of values of magnitude at most 1 are kept in units of 2^-52.
constexpr double kUnit = 0x1p-52;

}  // namespace

TileTotals::TileTotals(const TileLayout& layout, const std::vector<double>& areas)
    : strips_(layout.strips), areas_(layout.strips.n_rows()), sums_(layout.strips.n_rows()) {
  for (Index row = 0; row < areas_.size(); ++row) areas_[row] = areas[layout.order[row]];
}

void TileTotals::add(const ExchangeTile& tile) {
  const Index first_row = strips_.begin(tile.row_strip);
  for (Index r = 0; r < tile.values.rows(); ++r) {
    add_to_row(first_row + r, tile.values.row(r).sum());
  }
  if (tile.row_strip != tile.column_strip) {
    const Index first_column = strips_.begin(tile.column_strip);
    for (Index c = 0; c < tile.values.cols(); ++c) {
      add_to_row(first_column + c, tile.values.col(c).sum());
    }
  }
  const std::lock_guard lock(mutex_);
  census_ += tile.census;
}

void TileTotals::add_to_row(Index row, double exchange) {
  sums_[row].fetch_add(std::llround(exchange / areas_[row] / kUnit), std::memory_order_relaxed);
}

void TileTotals::add_over(Ranks& ranks) {
  std::vector<std::int64_t> sums(sums_.size());
  for (std::size_t row = 0; row < sums.size(); ++row) sums[row] = sums_[row].load();
  sum_over_ranks(ranks, sums);
  for (std::size_t row = 0; row < sums.size(); ++row) sums_[row] = sums[row];
  std::array counts = {census_.facing,  census_.visible, census_.hidden, census_.undecided,
                       census_.partial, census_.known,   census_.rays};
  sum_over_ranks(ranks, std::span<std::int64_t>(counts));
  census_ = {.facing = counts[0],
             .visible = counts[1],
             .hidden = counts[2],
             .undecided = counts[3],
             .partial = counts[4],
             .known = counts[5],
             .rays = counts[6]};
}

Eigen::VectorXd TileTotals::row_sums() const {
  Eigen::VectorXd result(areas_.size());
  for (Index row = 0; row < result.size(); ++row) {
    const auto sum = static_cast<double>(sums_[row].load(std::memory_order_relaxed)) * kUnit;
    result[row] = sum * areas_[row];
  }
  return result;
}

}  // namespace radiosity

#include "radiosity/stream/stored_balance.h"

#include <algorithm>
#include <utility>

#include "radiosity/assembly/tile_sum.h"

namespace radiosity {
namespace {

/// Each round takes a dozen passes through the file, which gaps of this relative size are not
/// worth.
constexpr double kNegligible = 5e-12;

/// Adds the product of a tile and of its mirror image with the columns of `block` to `sum`.
void add_product(const Eigen::MatrixXd& tile, Index first_row, Index first_column,
                 const Eigen::Ref<const Eigen::MatrixXd>& block, Eigen::Ref<Eigen::MatrixXd> sum) {
  const Index rows = tile.rows();
  const Index columns = tile.cols();
  sum.middleRows(first_row, rows).noalias() += tile * block.middleRows(first_column, columns);
  if (first_row == first_column) return;
  sum.middleRows(first_column, columns).noalias() +=
      tile.transpose() * block.middleRows(first_row, rows);
}

}  // namespace

StoredBalance::StoredBalance(const StoredClosure& closure, Eigen::VectorXd areas, double min_factor,
                             Eigen::VectorXd mask)
    : closure_(closure),
      areas_(std::move(areas)),
      min_factor_(min_factor),
      mask_(std::move(mask)) {}

/// A tile corrected for closure of which only pairs remain for which keep(is_small) holds.
template <typename Keep>
ExchangeTile StoredBalance::closed_tile(Index row_strip, Index column_strip,
                                        const Keep& keep) const {
  ExchangeTile tile = closure_.tile(row_strip, column_strip);
  if (min_factor_ == 0) return tile;
  const auto row_areas = areas_.segment(strips().begin(row_strip), tile.values.rows());
  const auto column_areas = areas_.segment(strips().begin(column_strip), tile.values.cols());
  const auto is_kept = [&](Index r, Index c) {
    return keep(tile.values(r, c) < min_factor_ * std::min(row_areas[r], column_areas[c]));
  };
  std::erase_if(tile.uncertain,
                [&](const UncertainEntry& entry) { return !is_kept(entry.row, entry.column); });
  for (Index c = 0; c < tile.values.cols(); ++c) {
    for (Index r = 0; r < tile.values.rows(); ++r) {
      if (!is_kept(r, c)) tile.values(r, c) = 0;
    }
  }
  return tile;
}

void StoredBalance::scale(ExchangeTile& tile) const {
  const Index first_row = strips().begin(tile.row_strip);
  const Index first_column = strips().begin(tile.column_strip);
  for (const Eigen::VectorXd& factors : rounds_) {
    for (Index c = 0; c < tile.values.cols(); ++c) {
      const Index j = first_column + c;
      for (Index r = 0; r < tile.values.rows(); ++r) {
        const Index i = first_row + r;
        const double change = mask_[i] * mask_[j] * (factors[i] + factors[j]);
        tile.values(r, c) *= std::max(0.0, 1 + change);
      }
    }
  }
}

ExchangeTile StoredBalance::tile(Index row_strip, Index column_strip) const {
  ExchangeTile tile = closed_tile(row_strip, column_strip, [](bool is_small) { return !is_small; });
  scale(tile);
  return tile;
}

Eigen::VectorXd StoredBalance::product(const Eigen::VectorXd& x) const {
  const auto add_tile = [this](Index row_strip, Index column_strip, const Eigen::MatrixXd& block,
                               Eigen::MatrixXd& sum) {
    add_product(tile(row_strip, column_strip).values, strips().begin(row_strip),
                strips().begin(column_strip), block, sum);
  };
  return sum_over_tiles(strips(), x, add_tile).col(0);
}

Eigen::VectorXd StoredBalance::weighted_sums(const Eigen::VectorXd& x) const {
  return mask_.cwiseProduct(product(mask_.cwiseProduct(x)));
}

Eigen::VectorXd StoredBalance::row_sums() const { return product(Eigen::VectorXd::Ones(size())); }

double StoredBalance::rounding() const { return std::max(closure_.rounding(), kNegligible); }

StoredBalance::Dropped StoredBalance::dropped() const {
  const auto add_tile = [this](Index row_strip, Index column_strip, const Eigen::MatrixXd& block,
                               Eigen::MatrixXd& sum) {
    const Index first_row = strips().begin(row_strip);
    const Index first_column = strips().begin(column_strip);
    const ExchangeTile small =
        closed_tile(row_strip, column_strip, [](bool is_small) { return is_small; });
    Eigen::MatrixXd count = (small.values.array() > 0).cast<double>();
    for (const UncertainEntry& entry : small.uncertain) count(entry.row, entry.column) = 1;
    add_product(small.values, first_row, first_column, block.col(0), sum.col(0));
    add_product(count, first_row, first_column, block.col(1), sum.col(1));
  };
  const Eigen::MatrixXd sums = sum_over_tiles(strips(), Eigen::MatrixXd::Ones(size(), 2), add_tile);
  return {sums.col(0), sums.col(1)};
}

}  // namespace radiosity

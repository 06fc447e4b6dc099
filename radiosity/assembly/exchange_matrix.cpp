#include "radiosity/assembly/exchange_matrix.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "radiosity/assembly/tile_product.h"
#include "radiosity/assembly/tile_sum.h"
#include "radiosity/base/parallel.h"

namespace radiosity {
namespace {

/// Up to this many rows entries are float64: 1 MB is no matter, and small cases come out exact.
constexpr Index kDoubleRows = 512;

bool is_before(const UncertainEntry& a, const UncertainEntry& b) {
  return a.column < b.column || (a.column == b.column && a.row < b.row);
}

/// The tiles that are kept here: from the first to before the second.
std::pair<Index, Index> tile_range(const Strips& strips, const Ranks* ranks) {
  if (ranks == nullptr) return {0, strips.n_tiles()};
  const SumParts parts(strips);
  const auto [first, last] = parts.share(ranks->rank(), ranks->size());
  return {parts.begin(first), parts.begin(last)};
}

double variance(const UncertainEntry& entry) {
  return static_cast<double>(entry.error) * entry.error;
}

}  // namespace

ExchangeMatrix::ExchangeMatrix(const Strips& strips, Ranks* ranks)
    : strips_(strips),
      ranks_(ranks),
      first_tile_(tile_range(strips, ranks).first),
      tiles_(tile_range(strips, ranks).second - first_tile_),
      diagonal_(Eigen::VectorXd::Zero(size())),
      is_double_(size() <= kDoubleRows) {}

Index ExchangeMatrix::place_of(Index row_strip, Index column_strip) const {
  const Index place = Strips::tile(row_strip, column_strip) - first_tile_;
  return place < static_cast<Index>(tiles_.size()) ? std::max<Index>(place, -1) : -1;
}

void ExchangeMatrix::unite(Eigen::VectorXd& values) const {
  if (ranks_ == nullptr) return;
  sum_over_ranks(*ranks_, {values.data(), static_cast<std::size_t>(values.size())});
}

void ExchangeMatrix::set(ExchangeTile tile) {
  Tile& place = *find(tile.row_strip, tile.column_strip);
  place.uncertain = std::move(tile.uncertain);
  place.uncertain.shrink_to_fit();
  std::sort(place.uncertain.begin(), place.uncertain.end(), is_before);
  if (!tile.values.isZero(0)) store(place, tile.values);
}

void ExchangeMatrix::store(Tile& tile, const Eigen::MatrixXd& values) const {
  if (is_double_) {
    if (!tile.twice) tile.twice = std::make_unique<double[]>(values.size());
    std::copy(values.data(), values.data() + values.size(), tile.twice.get());
  } else {
    if (!tile.single) tile.single = std::make_unique<float[]>(values.size());
    std::transform(values.data(), values.data() + values.size(), tile.single.get(),
                   [](double value) { return static_cast<float>(value); });
  }
}

void ExchangeMatrix::store_entry(Tile& tile, Index n_entries, Index place, double value) const {
  if (is_double_) {
    if (!tile.twice) tile.twice = std::make_unique<double[]>(n_entries);
    tile.twice[place] = value;
  } else {
    if (!tile.single) tile.single = std::make_unique<float[]>(n_entries);
    tile.single[place] = static_cast<float>(value);
  }
}

void ExchangeMatrix::set_row(Index i, const Eigen::VectorXd& values,
                             const Eigen::VectorXd& errors) {
  const Index strip = strips_.of_row(i);
  const Index n_rows = strips_.rows(strip);
  const Index row = i - strips_.begin(strip);
  for (Index other = strip; other < strips_.size(); ++other) {
    Tile* held = find(strip, other);
    if (held == nullptr) continue;
    Tile& tile = *held;
    for (Index column = 0; column < strips_.rows(other); ++column) {
      const Index j = strips_.begin(other) + column;
      if (values[j] != 0) {
        store_entry(tile, n_rows * strips_.rows(other), row + column * n_rows, values[j]);
      }
      if (errors[j] == 0) continue;
      const UncertainEntry entry{static_cast<std::uint16_t>(row),
                                 static_cast<std::uint16_t>(column), static_cast<float>(errors[j])};
      tile.uncertain.insert(
          std::upper_bound(tile.uncertain.begin(), tile.uncertain.end(), entry, is_before), entry);
    }
  }
}

/// Calls change(tile, k, i, j, place) for the k-th uncertain entry of each tile, at (i, j) of the
/// matrix and that place of the tile.
template <typename Change>
void ExchangeMatrix::change_uncertain(const Change& change) {
  parallel_for(strips_.size(), [&](Index column_strip) {
    for (Index row_strip = 0; row_strip <= column_strip; ++row_strip) {
      Tile* tile = find(row_strip, column_strip);
      if (tile == nullptr) continue;
      for (std::size_t k = 0; k < tile->uncertain.size(); ++k) {
        const UncertainEntry& entry = tile->uncertain[k];
        change(*tile, k, strips_.begin(row_strip) + entry.row,
               strips_.begin(column_strip) + entry.column,
               entry.row + static_cast<Index>(entry.column) * strips_.rows(row_strip));
      }
    }
  });
}

void ExchangeMatrix::freeze(const Eigen::VectorXd& mask) {
  for (Tile& tile : tiles_) tile.is_fixed.assign(tile.uncertain.size(), false);
  change_uncertain([&](Tile& tile, std::size_t k, Index i, Index j, Index) {
    tile.is_fixed[k] = mask[i] == 0 || mask[j] == 0;
  });
}

void ExchangeMatrix::adjust(const Eigen::VectorXd& factors) {
  change_uncertain([&](Tile& tile, std::size_t k, Index i, Index j, Index place) {
    if (!tile.may_change(k)) return;
    tile.is_fixed.resize(tile.uncertain.size());
    if (!tile.single && !tile.twice) {  // an empty tile has zeros only, which may not fall
      tile.is_fixed[k] = true;
      return;
    }
    double value = tile.single ? static_cast<double>(tile.single[place]) : tile.twice[place];
    tile.is_fixed[k] = !change_entry(value, tile.uncertain[k].error, factors[i] + factors[j]);
    if (tile.single) tile.single[place] = static_cast<float>(value);
    if (tile.twice) tile.twice[place] = value;
  });
}

void ExchangeMatrix::set_row_sums(const Eigen::VectorXd& sums) {
  for (Tile& tile : tiles_) tile.is_fixed = {};
  if (is_double_) return;  // nothing was rounded
  diagonal_.setZero();
  diagonal_ = sums - row_sums();
}

template <typename Block>
Eigen::MatrixXd ExchangeMatrix::product_by(const Eigen::MatrixXd& x) const {
  constexpr Index kColumns = Block::ColsAtCompileTime;
  const auto add_tile = [this](Index row_strip, Index column_strip, const Block& block,
                               Block& sum) {
    const Tile& tile = *find(row_strip, column_strip);
    const Index row = strips_.begin(row_strip);
    const Index column = strips_.begin(column_strip);
    Block unused;
    if (row_strip == column_strip) unused = Block::Zero(strips_.rows(row_strip), kColumns);
    double* below = row_strip == column_strip ? unused.data() : sum.row(column).data();
    const TileShape shape{strips_.rows(row_strip), strips_.rows(column_strip)};
    const double* x_rows = block.row(row).data();
    const double* x_columns = block.row(column).data();
    double* above = sum.row(row).data();
    const auto multiply = [&](const auto* entries) {
      multiply_tile<kColumns>(entries, shape, x_rows, x_columns, above, below);
    };
    if (tile.single) multiply(tile.single.get());
    if (tile.twice) multiply(tile.twice.get());
  };
  return sum_over_tiles<Block>(strips_, x, add_tile, ranks_);
}

Eigen::MatrixXd ExchangeMatrix::product(const Eigen::MatrixXd& x) const {
  Eigen::MatrixXd result = x.cols() <= kFewProductColumns
                               ? product_by<RowsOf<kFewProductColumns>>(x)
                               : product_by<RowBlock>(x);
  result.noalias() += diagonal_.asDiagonal() * x;
  return result;
}

/// Σ_j term(tile, k) x_j over the uncertain entries.
template <typename Term>
Eigen::MatrixXd ExchangeMatrix::sum_entries(const Eigen::MatrixXd& x, const Term& term) const {
  const auto add_tile = [&](Index row_strip, Index column_strip, const RowBlock& block,
                            RowBlock& sum) {
    const Tile& tile = *find(row_strip, column_strip);
    for (std::size_t k = 0; k < tile.uncertain.size(); ++k) {
      const UncertainEntry& entry = tile.uncertain[k];
      const double factor = term(tile, k);
      const Index i = strips_.begin(row_strip) + entry.row;
      const Index j = strips_.begin(column_strip) + entry.column;
      sum.row(i) += factor * block.row(j);
      if (row_strip != column_strip) sum.row(j) += factor * block.row(i);
    }
  };
  return sum_over_tiles<RowBlock>(strips_, x, add_tile, ranks_);
}

Eigen::MatrixXd ExchangeMatrix::error_product(const Eigen::MatrixXd& x) const {
  return sum_entries(x,
                     [](const Tile& tile, std::size_t k) { return variance(tile.uncertain[k]); });
}

Eigen::VectorXd ExchangeMatrix::weighted_sums(const Eigen::VectorXd& x) const {
  return sum_entries(x,
                     [](const Tile& tile, std::size_t k) {
                       return tile.may_change(k) ? variance(tile.uncertain[k]) : 0;
                     })
      .col(0);
}

Eigen::VectorXd ExchangeMatrix::row_variances() const {
  return error_product(Eigen::VectorXd::Ones(size())).col(0);
}

Eigen::VectorXd ExchangeMatrix::row_errors() const {
  return sum_entries(Eigen::VectorXd::Ones(size()),
                     [](const Tile& tile, std::size_t k) {
                       return static_cast<double>(tile.uncertain[k].error);
                     })
      .col(0);
}

Eigen::VectorXd ExchangeMatrix::row_sums() const {
  return product(Eigen::VectorXd::Ones(size())).col(0);
}

Eigen::VectorXd ExchangeMatrix::own_row(Index i) const {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(size());
  const Index strip = strips_.of_row(i);
  const Index local = i - strips_.begin(strip);
  for (Index other = 0; other < strips_.size(); ++other) {
    const Tile* tile = find(std::min(strip, other), std::max(strip, other));
    if (tile == nullptr) continue;
    const Index rows = strips_.rows(std::min(strip, other));
    for (Index k = 0; k < strips_.rows(other); ++k) {
      const Index place = other < strip ? k + local * rows : local + k * rows;
      result[strips_.begin(other) + k] = tile->single  ? static_cast<double>(tile->single[place])
                                         : tile->twice ? tile->twice[place]
                                                       : 0.0;
    }
  }
  return result;
}

Eigen::VectorXd ExchangeMatrix::row(Index i) const {
  Eigen::VectorXd result = own_row(i);
  unite(result);
  return result;
}

ExchangeArea ExchangeMatrix::entry(Index i, Index j) const {
  Index row_strip = strips_.of_row(i);
  Index column_strip = strips_.of_row(j);
  if (row_strip > column_strip) {
    std::swap(row_strip, column_strip);
    std::swap(i, j);
  }
  const Index row = i - strips_.begin(row_strip);
  const Index column = j - strips_.begin(column_strip);
  const Index place = row + column * strips_.rows(row_strip);
  Eigen::VectorXd found = Eigen::VectorXd::Zero(3);  // value, error, whether it is uncertain
  if (const Tile* tile = find(row_strip, column_strip)) {
    if (tile->single) found[0] = tile->single[place];
    if (tile->twice) found[0] = tile->twice[place];
    const UncertainEntry wanted{static_cast<std::uint16_t>(row), static_cast<std::uint16_t>(column),
                                0};
    const auto same =
        std::lower_bound(tile->uncertain.begin(), tile->uncertain.end(), wanted, is_before);
    if (same != tile->uncertain.end() && !is_before(wanted, *same)) {
      found[1] = same->error;
      found[2] = 1;
    }
  }
  unite(found);
  return {.value = found[0], .error = found[1], .is_certain = found[2] == 0};
}

Eigen::VectorXd ExchangeMatrix::row_error(Index i) const {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(size());
  const Index strip = strips_.of_row(i);
  const Index local = i - strips_.begin(strip);
  for (Index other = 0; other < strips_.size(); ++other) {
    const Tile* tile = find(std::min(strip, other), std::max(strip, other));
    if (tile == nullptr) continue;
    for (const UncertainEntry& entry : tile->uncertain) {
      const Index own = other < strip ? entry.column : entry.row;
      const Index partner = other < strip ? entry.row : entry.column;
      if (own == local) result[strips_.begin(other) + partner] = entry.error;
    }
  }
  unite(result);
  return result;
}

std::size_t ExchangeMatrix::bytes() const {
  std::size_t sum = tiles_.size() * sizeof(Tile) + diagonal_.size() * sizeof(double);
  for (Index column_strip = 0; column_strip < strips_.size(); ++column_strip) {
    for (Index row_strip = 0; row_strip <= column_strip; ++row_strip) {
      const Tile* tile = find(row_strip, column_strip);
      if (tile == nullptr) continue;
      const auto entries =
          static_cast<std::size_t>(strips_.rows(row_strip) * strips_.rows(column_strip));
      if (tile->single) sum += entries * sizeof(float);
      if (tile->twice) sum += entries * sizeof(double);
      sum += tile->uncertain.capacity() * sizeof(UncertainEntry);
    }
  }
  return sum;
}

}  // namespace radiosity

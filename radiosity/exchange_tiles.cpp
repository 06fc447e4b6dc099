#include "radiosity/exchange_tiles.h"

#include <algorithm>
#include <cmath>

#include "radiosity/parallel.h"

namespace radiosity {
namespace {

/// Up to this many rows entries are float64: 1 MB is no matter, and small cases come out exact.
constexpr Index kDoubleRows = 512;
/// Sums are made in this many parts, whatever the number of threads, and added in order.
constexpr Index kParts = 64;
/// Columns that go through the tiles at once, which bounds the parts' memory.
constexpr Index kColumnsAtOnce = 8;

}  // namespace

ExchangeTiles::ExchangeTiles(std::vector<Index> boundaries)
    : boundaries_(std::move(boundaries)),
      tiles_(n_strips() * (n_strips() + 1) / 2),
      diagonal_(Eigen::VectorXd::Zero(size())),
      is_double_(size() <= kDoubleRows) {}

Index ExchangeTiles::tile_index(Index row_strip, Index column_strip) const {
  return column_strip * (column_strip + 1) / 2 + row_strip;
}

void ExchangeTiles::set(Index row_strip, Index column_strip, const Eigen::MatrixXd& values,
                        std::vector<UncertainEntry> uncertain) {
  Tile& tile = tiles_[tile_index(row_strip, column_strip)];
  tile.uncertain = std::move(uncertain);
  tile.uncertain.shrink_to_fit();
  if (!values.isZero(0)) store(tile, values);
}

void ExchangeTiles::store(Tile& tile, const Eigen::MatrixXd& values) const {
  if (is_double_) {
    if (!tile.twice) tile.twice = std::make_unique<double[]>(values.size());
    std::copy(values.data(), values.data() + values.size(), tile.twice.get());
  } else {
    if (!tile.single) tile.single = std::make_unique<float[]>(values.size());
    std::transform(values.data(), values.data() + values.size(), tile.single.get(),
                   [](double value) { return static_cast<float>(value); });
  }
}

Eigen::MatrixXd ExchangeTiles::values(const Tile& tile, Index rows, Index columns) const {
  if (tile.single) {
    return Eigen::Map<const Eigen::MatrixXf>(tile.single.get(), rows, columns).cast<double>();
  }
  if (tile.twice) return Eigen::Map<const Eigen::MatrixXd>(tile.twice.get(), rows, columns);
  return Eigen::MatrixXd::Zero(rows, columns);
}

template <typename Change>
void ExchangeTiles::change_uncertain(const Change& change) {
  parallel_for(n_strips(), [&](Index column_strip) {
    for (Index row_strip = 0; row_strip <= column_strip; ++row_strip) {
      Tile& tile = tiles_[tile_index(row_strip, column_strip)];
      for (UncertainEntry& entry : tile.uncertain) {
        change(tile, entry, strip_begin(row_strip) + entry.row,
               strip_begin(column_strip) + entry.column,
               entry.row + static_cast<Index>(entry.column) * strip_size(row_strip));
      }
    }
  });
}

void ExchangeTiles::freeze(const Eigen::VectorXd& mask) {
  change_uncertain([&](Tile&, UncertainEntry& entry, Index i, Index j, Index) {
    if (mask[i] == 0 || mask[j] == 0) entry.error = -std::abs(entry.error);
  });
}

void ExchangeTiles::unfreeze() {
  change_uncertain([](Tile&, UncertainEntry& entry, Index, Index, Index) {
    entry.error = std::abs(entry.error);
  });
}

void ExchangeTiles::correct(const Eigen::VectorXd& factors) {
  change_uncertain([&](Tile& tile, UncertainEntry& entry, Index i, Index j, Index place) {
    if (entry.error <= 0) return;
    const double variance = static_cast<double>(entry.error) * entry.error;
    const double change = variance * (factors[i] + factors[j]);
    if (!tile.single && !tile.twice) {  // an empty tile has zeros only, which may not fall
      entry.error = -entry.error;
      return;
    }
    const double value =
        change + (tile.single ? static_cast<double>(tile.single[place]) : tile.twice[place]);
    if (value < 0) entry.error = -entry.error;
    if (tile.single) tile.single[place] = static_cast<float>(std::max(value, 0.0));
    if (tile.twice) tile.twice[place] = std::max(value, 0.0);
  });
}

void ExchangeTiles::set_row_sums(const Eigen::VectorXd& row_sums) {
  if (is_double_) return;  // nothing was rounded
  diagonal_.setZero();
  diagonal_ = row_sums - product(Eigen::VectorXd::Ones(size())).col(0);
}

template <typename AddTile>
Eigen::MatrixXd ExchangeTiles::sum_over_tiles(const Eigen::MatrixXd& x, const AddTile& add) const {
  const auto n_tiles = static_cast<Index>(tiles_.size());
  Eigen::MatrixXd result(x.rows(), x.cols());
  for (Index first = 0; first < x.cols(); first += kColumnsAtOnce) {
    const Index n_columns = std::min(kColumnsAtOnce, x.cols() - first);
    const Eigen::MatrixXd block = x.middleCols(first, n_columns);
    std::vector<Eigen::MatrixXd> parts(std::min(kParts, std::max<Index>(n_tiles, 1)));
    const auto n_parts = static_cast<Index>(parts.size());
    parallel_for(n_parts, [&](Index part) {
      parts[part] = Eigen::MatrixXd::Zero(x.rows(), n_columns);
      Index column_strip = 0;
      Index row_strip = 0;
      const Index begin = n_tiles * part / n_parts;
      const Index end = n_tiles * (part + 1) / n_parts;
      while (tile_index(0, column_strip + 1) <= begin) ++column_strip;
      row_strip = begin - tile_index(0, column_strip);
      for (Index t = begin; t < end; ++t) {
        add(tiles_[t], row_strip, column_strip, block, parts[part]);
        if (++row_strip > column_strip) {
          row_strip = 0;
          ++column_strip;
        }
      }
    });
    parallel_for(
        x.rows(),
        [&](Index i) {
          for (Index c = 0; c < n_columns; ++c) {
            double sum = 0;
            for (const Eigen::MatrixXd& part : parts) sum += part(i, c);
            result(i, first + c) = sum;
          }
        },
        256);
  }
  return result;
}

Eigen::MatrixXd ExchangeTiles::product(const Eigen::MatrixXd& x) const {
  Eigen::MatrixXd result =
      sum_over_tiles(x, [this](const Tile& tile, Index row_strip, Index column_strip,
                               const Eigen::MatrixXd& block, Eigen::MatrixXd& sum) {
        if (!tile.single && !tile.twice) return;
        const Index rows = strip_size(row_strip);
        const Index columns = strip_size(column_strip);
        const Eigen::MatrixXd g = values(tile, rows, columns);
        for (Index c = 0; c < block.cols(); ++c) {
          sum.col(c).segment(strip_begin(row_strip), rows).noalias() +=
              g * block.col(c).segment(strip_begin(column_strip), columns);
          if (row_strip == column_strip) continue;
          sum.col(c).segment(strip_begin(column_strip), columns).noalias() +=
              g.transpose() * block.col(c).segment(strip_begin(row_strip), rows);
        }
      });
  result.noalias() += diagonal_.asDiagonal() * x;
  return result;
}

Eigen::MatrixXd ExchangeTiles::sum_variances(const Eigen::MatrixXd& x, bool with_frozen) const {
  const auto add_tile = [&](const Tile& tile, Index row_strip, Index column_strip,
                            const Eigen::MatrixXd& block, Eigen::MatrixXd& sum) {
    const Index first_row = strip_begin(row_strip);
    const Index first_column = strip_begin(column_strip);
    for (Index c = 0; c < block.cols(); ++c) {
      const double* in = block.col(c).data();
      double* out = sum.col(c).data();
      for (const UncertainEntry& entry : tile.uncertain) {
        if (entry.error < 0 && !with_frozen) continue;
        const double variance = static_cast<double>(entry.error) * entry.error;
        const Index i = first_row + entry.row;
        const Index j = first_column + entry.column;
        out[i] += variance * in[j];
        if (row_strip != column_strip) out[j] += variance * in[i];
      }
    }
  };
  return sum_over_tiles(x, add_tile);
}

Eigen::MatrixXd ExchangeTiles::error_product(const Eigen::MatrixXd& x) const {
  return sum_variances(x, true);
}

Eigen::VectorXd ExchangeTiles::free_error_product(const Eigen::VectorXd& x) const {
  return sum_variances(x, false).col(0);
}

Eigen::VectorXd ExchangeTiles::row(Index i) const {
  Eigen::VectorXd result(size());
  const Index strip =
      std::upper_bound(boundaries_.begin(), boundaries_.end(), i) - boundaries_.begin() - 1;
  const Index local = i - strip_begin(strip);
  for (Index other = 0; other < n_strips(); ++other) {
    const Tile& tile = tiles_[tile_index(std::min(strip, other), std::max(strip, other))];
    const Index rows = strip_size(std::min(strip, other));
    for (Index k = 0; k < strip_size(other); ++k) {
      const Index place = other < strip ? k + local * rows : local + k * rows;
      result[strip_begin(other) + k] = tile.single  ? static_cast<double>(tile.single[place])
                                       : tile.twice ? tile.twice[place]
                                                    : 0.0;
    }
  }
  return result;
}

Eigen::VectorXd ExchangeTiles::row_error(Index i) const {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(size());
  const Index strip =
      std::upper_bound(boundaries_.begin(), boundaries_.end(), i) - boundaries_.begin() - 1;
  const Index local = i - strip_begin(strip);
  for (Index other = 0; other < n_strips(); ++other) {
    const Tile& tile = tiles_[tile_index(std::min(strip, other), std::max(strip, other))];
    for (const UncertainEntry& entry : tile.uncertain) {
      const Index own = other < strip ? entry.column : entry.row;
      const Index partner = other < strip ? entry.row : entry.column;
      if (own == local) result[strip_begin(other) + partner] = entry.error;
    }
  }
  return result;
}

std::size_t ExchangeTiles::bytes() const {
  std::size_t sum = tiles_.size() * sizeof(Tile) + diagonal_.size() * sizeof(double);
  for (Index column_strip = 0; column_strip < n_strips(); ++column_strip) {
    for (Index row_strip = 0; row_strip <= column_strip; ++row_strip) {
      const Tile& tile = tiles_[tile_index(row_strip, column_strip)];
      const auto entries =
          static_cast<std::size_t>(strip_size(row_strip) * strip_size(column_strip));
      if (tile.single) sum += entries * sizeof(float);
      if (tile.twice) sum += entries * sizeof(double);
      sum += tile.uncertain.capacity() * sizeof(UncertainEntry);
    }
  }
  return sum;
}

}  // namespace radiosity

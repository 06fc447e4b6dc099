#include "radiosity/stream/row_stream.h"

#include <algorithm>
#include <vector>

#include "radiosity/base/parallel.h"

namespace radiosity {
namespace {

using RowMajorValues = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using RowMajorErrors = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// A range of rows of G under collection, by patch.
class RowBlock {
 public:
  RowBlock(const TileLayout& layout, Index n_rows)
      : layout_(layout),
        values_(n_rows, layout.strips.n_rows()),
        errors_(n_rows, layout.strips.n_rows()) {}

  /// Collects the rows of `n_rows` patches from `first` on.
  void collect(const StoredBalance& exchange, Index first, Index n_rows, const Progress& progress) {
    first_ = first;
    n_rows_ = n_rows;
    values_.setZero();
    errors_.setZero();
    const std::vector<bool> is_touched = touched_strips();
    const Index n_strips = layout_.strips.size();
    parallel_for(n_strips, [&](Index column_strip) {
      for (Index row_strip = 0; row_strip <= column_strip; ++row_strip) {
        if (!is_touched[row_strip] && !is_touched[column_strip]) continue;
        progress.check();
        add(exchange.tile(row_strip, column_strip));
      }
    });
  }

  [[nodiscard]] Eigen::VectorXd values(Index patch) const { return values_.row(patch - first_); }
  [[nodiscard]] Eigen::VectorXd errors(Index patch) const {
    return errors_.row(patch - first_).cast<double>();
  }

 private:
  [[nodiscard]] bool holds(Index patch) const {
    return patch >= first_ && patch < first_ + n_rows_;
  }

  [[nodiscard]] std::vector<bool> touched_strips() const {
    std::vector<bool> is_touched(layout_.strips.size());
    for (Index strip = 0; strip < layout_.strips.size(); ++strip) {
      const auto begin = layout_.order.begin() + layout_.strips.begin(strip);
      is_touched[strip] = std::any_of(begin, begin + layout_.strips.rows(strip),
                                      [this](std::int32_t patch) { return holds(patch); });
    }
    return is_touched;
  }

  /// Different tiles write to different places.
  void add(const ExchangeTile& tile) {
    const std::int32_t* row_patch = layout_.order.data() + layout_.strips.begin(tile.row_strip);
    const std::int32_t* column_patch =
        layout_.order.data() + layout_.strips.begin(tile.column_strip);
    const bool is_diagonal = tile.row_strip == tile.column_strip;
    const auto scatter = [&](auto& block, Index r, Index c, auto value) {
      const Index i = row_patch[r];
      const Index j = column_patch[c];
      if (holds(i)) block(i - first_, j) = value;
      if (!is_diagonal && holds(j)) block(j - first_, i) = value;
    };
    for (Index c = 0; c < tile.values.cols(); ++c) {
      for (Index r = 0; r < tile.values.rows(); ++r) scatter(values_, r, c, tile.values(r, c));
    }
    for (const UncertainEntry& entry : tile.uncertain) {
      scatter(errors_, entry.row, entry.column, entry.error);
    }
  }

  const TileLayout& layout_;
  RowMajorValues values_;
  RowMajorErrors errors_;
  Index first_ = 0;
  Index n_rows_ = 0;
};

}  // namespace

void stream_rows(const StoredBalance& exchange, const TileLayout& layout,
                 const std::vector<double>& areas, const RowVisitor& visit,
                 const RowStreamOptions& options) {
  const Index n = layout.strips.n_rows();
  const auto affordable = static_cast<Index>(options.memory / row_bytes(n));
  const Index n_rows = std::clamp<Index>(affordable, 1, n);
  RowBlock block(layout, n_rows);
  for (Index i = 0; i < n; ++i) {
    options.progress.check();
    if (i % n_rows == 0) {
      block.collect(exchange, i, std::min(n_rows, n - i), options.progress);
    }
    visit(i, block.values(i) / areas[i], block.errors(i) / areas[i]);
    if (options.progress.report) {
      options.progress.report("file", static_cast<double>(i + 1), static_cast<double>(n), "rows");
    }
  }
}

}  // namespace radiosity

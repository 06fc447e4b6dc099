#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "radiosity/base/geometry.h"

namespace radiosity {

/// The rows of a symmetric matrix divided into strips, and with them its upper triangle into tiles:
/// one for each pair of strips, row strip <= column strip.
class Strips {
 public:
  /// Divides the rows at `boundaries` (first 0, last n) into strips of at most 65535 rows.
  explicit Strips(std::vector<Index> boundaries) : boundaries_(std::move(boundaries)) {}

  [[nodiscard]] Index n_rows() const { return boundaries_.back(); }
  [[nodiscard]] Index size() const { return static_cast<Index>(boundaries_.size()) - 1; }
  [[nodiscard]] Index begin(Index strip) const { return boundaries_[strip]; }
  [[nodiscard]] Index rows(Index strip) const {
    return boundaries_[strip + 1] - boundaries_[strip];
  }
  /// The strip that holds a row.
  [[nodiscard]] Index of_row(Index row) const {
    return std::upper_bound(boundaries_.begin(), boundaries_.end(), row) - boundaries_.begin() - 1;
  }

  [[nodiscard]] Index n_tiles() const { return size() * (size() + 1) / 2; }
  /// Number of a tile, counted down the columns of the triangle.
  [[nodiscard]] static Index tile(Index row_strip, Index column_strip) {
    return column_strip * (column_strip + 1) / 2 + row_strip;
  }

 private:
  std::vector<Index> boundaries_;
};

}  // namespace radiosity

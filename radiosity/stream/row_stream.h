#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>

#include "radiosity/base/geometry.h"
#include "radiosity/base/progress.h"
#include "radiosity/stream/stored_balance.h"

namespace radiosity {

/// Takes row i of F and its standard errors, n each.
using RowVisitor =
    std::function<void(Index i, const Eigen::VectorXd& row, const Eigen::VectorXd& error)>;

struct RowStreamOptions {
  std::size_t memory = 0;  ///< bytes for rows on their way; one row is always kept
  Progress progress{};     ///< stage "file", rows
};

/// Bytes that one of n rows takes on its way.
constexpr std::size_t row_bytes(Index n) {
  return static_cast<std::size_t>(n) * (sizeof(double) + sizeof(float));
}

/// Visits the rows of F in the order of the patches, 0 to n - 1. Goes through the file in as many
/// passes as the memory demands, each collecting a range of rows from the tiles that touch it; the
/// rows do not depend on it. `areas` are those of the patches, m².
void stream_rows(const StoredBalance& exchange, const TileLayout& layout,
                 const std::vector<double>& areas, const RowVisitor& visit,
                 const RowStreamOptions& options);

}  // namespace radiosity

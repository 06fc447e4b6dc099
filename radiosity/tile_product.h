#pragma once

#include <Eigen/Core>

namespace radiosity {

/// Columns that `multiply_tile` takes at once.
inline constexpr Eigen::Index kProductColumns = 8;

/// So many columns of all rows, row after row.
using RowBlock = Eigen::Matrix<double, Eigen::Dynamic, kProductColumns, Eigen::RowMajor>;

/// The size of a tile.
struct TileShape {
  Eigen::Index n_rows;
  Eigen::Index n_columns;
};

/// The product of a tile G (column-major) with columns above and below the diagonal:
/// `above` += G x_columns and `below` += Gᵀ x_rows, all of them rows of a RowBlock, in double
/// precision. In one pass over the tile, with AVX2 and FMA where the processor has them.
void multiply_tile(const float* tile, const TileShape& shape, const double* x_rows,
                   const double* x_columns, double* above, double* below);
void multiply_tile(const double* tile, const TileShape& shape, const double* x_rows,
                   const double* x_columns, double* above, double* below);

}  // namespace radiosity

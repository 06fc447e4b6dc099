#pragma once

#include <Eigen/Core>

#include "radiosity/base/geometry.h"

namespace radiosity {

/// Columns that `multiply_tile` takes at once.
inline constexpr Eigen::Index kProductColumns = 8;
/// The same if there are few, which takes two thirds of the time.
inline constexpr Eigen::Index kFewProductColumns = 4;

/// So many columns of all rows, row after row.
template <Eigen::Index kColumns>
using RowsOf = Eigen::Matrix<double, Eigen::Dynamic, kColumns, Eigen::RowMajor>;
using RowBlock = RowsOf<kProductColumns>;

/// The size of a tile.
struct TileShape {
  Eigen::Index n_rows;
  Eigen::Index n_columns;
};

/// The product of a tile G (column-major) with columns above and below the diagonal:
/// `above` += G x_columns and `below` += Gᵀ x_rows, all of them rows of a RowsOf<kColumns>, in
/// double precision. In one pass over the tile, with AVX2 and FMA where the processor has them.
/// For entries of float or double, and either number of columns.
template <Eigen::Index kColumns, typename Entry>
void multiply_tile(const Entry* tile, const TileShape& shape, const double* x_rows,
                   const double* x_columns, double* above, double* below);

}  // namespace radiosity

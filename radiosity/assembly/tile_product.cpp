#include "radiosity/assembly/tile_product.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include "radiosity/base/wide_instructions.h"

namespace radiosity {
namespace {

using Eigen::Index;

/// The tile and the rows of its factors, row after row.
template <typename Entry>
struct TileProduct {
  const Entry* tile;
  TileShape shape;
  const double* x_rows;
  const double* x_columns;
  double* above;
  double* below;
};

template <Index kColumns, typename Entry>
void multiply_portably(const TileProduct<Entry>& p) {
  using Tile = Eigen::Matrix<Entry, Eigen::Dynamic, Eigen::Dynamic>;
  using Rows = RowsOf<kColumns>;
  const Eigen::MatrixXd g =
      Eigen::Map<const Tile>(p.tile, p.shape.n_rows, p.shape.n_columns).template cast<double>();
  const Eigen::Map<const Rows> x_rows(p.x_rows, p.shape.n_rows, kColumns);
  const Eigen::Map<const Rows> x_columns(p.x_columns, p.shape.n_columns, kColumns);
  Eigen::Map<Rows>(p.above, p.shape.n_rows, kColumns).noalias() += g * x_columns;
  Eigen::Map<Rows>(p.below, p.shape.n_columns, kColumns).noalias() += g.transpose() * x_rows;
}

#if defined(__x86_64__)

/// The columns of one row in one or two registers.
template <Index kColumns>
struct Row;

template <>
struct Row<4> {
  __m256d low;
};

template <>
struct Row<8> {
  __m256d low;
  __m256d high;
};

template <Index kColumns>
[[gnu::target("avx2,fma"), gnu::always_inline]] inline Row<kColumns> load(const double* row) {
  if constexpr (kColumns == 4)
    return {_mm256_loadu_pd(row)};
  else
    return {_mm256_loadu_pd(row), _mm256_loadu_pd(row + 4)};
}

template <Index kColumns>
[[gnu::target("avx2,fma"), gnu::always_inline]] inline void store(const Row<kColumns>& row,
                                                                  double* place) {
  _mm256_storeu_pd(place, row.low);
  if constexpr (kColumns == 8) _mm256_storeu_pd(place + 4, row.high);
}

/// sum + factor * row
template <Index kColumns>
[[gnu::target("avx2,fma"), gnu::always_inline]] inline Row<kColumns> add(const Row<kColumns>& sum,
                                                                         __m256d factor,
                                                                         const Row<kColumns>& row) {
  if constexpr (kColumns == 4) {
    return {_mm256_fmadd_pd(factor, row.low, sum.low)};
  } else {
    return {_mm256_fmadd_pd(factor, row.low, sum.low), _mm256_fmadd_pd(factor, row.high, sum.high)};
  }
}

/// An entry of the tile, everywhere.
[[gnu::target("avx2,fma"), gnu::always_inline]] inline __m256d spread(const float* entry) {
  return _mm256_cvtps_pd(_mm_broadcast_ss(entry));
}
[[gnu::target("avx2,fma"), gnu::always_inline]] inline __m256d spread(const double* entry) {
  return _mm256_broadcast_sd(entry);
}

/// Takes kStep columns of the tile at once, so that rows are loaded and stored less often and
/// enough sums are under way to hide how long one addition takes.
template <Index kColumns, Index kStep, typename Entry>
[[gnu::target("avx2,fma")]] void multiply_columns(const TileProduct<Entry>& p, Index j) {
  const Entry* g = p.tile + j * p.shape.n_rows;
  Row<kColumns> in[kStep];
  Row<kColumns> sum[kStep] = {};
#pragma GCC unroll 4
  for (Index s = 0; s < kStep; ++s) {
    in[s] = load<kColumns>(p.x_columns + kColumns * (j + s));
  }
  for (Index i = 0; i < p.shape.n_rows; ++i) {
    const Row<kColumns> row = load<kColumns>(p.x_rows + kColumns * i);
    Row<kColumns> out = load<kColumns>(p.above + kColumns * i);
#pragma GCC unroll 4
    for (Index s = 0; s < kStep; ++s) {
      const __m256d entry = spread(g + i + s * p.shape.n_rows);
      out = add(out, entry, in[s]);
      sum[s] = add(sum[s], entry, row);
    }
    store(out, p.above + kColumns * i);
  }
#pragma GCC unroll 4
  for (Index s = 0; s < kStep; ++s) {
    double* out = p.below + kColumns * (j + s);
    store(add(load<kColumns>(out), _mm256_set1_pd(1), sum[s]), out);
  }
}

template <Index kColumns, typename Entry>
void multiply_widely(const TileProduct<Entry>& p) {
  constexpr Index kStep = 16 / kColumns;
  Index j = 0;
  for (; j + kStep <= p.shape.n_columns; j += kStep) multiply_columns<kColumns, kStep>(p, j);
  for (; j < p.shape.n_columns; ++j) multiply_columns<kColumns, 1>(p, j);
}

#endif

}  // namespace

template <Index kColumns, typename Entry>
void multiply_tile(const Entry* tile, const TileShape& shape, const double* x_rows,
                   const double* x_columns, double* above, double* below) {
  const TileProduct<Entry> product{tile, shape, x_rows, x_columns, above, below};
#if defined(__x86_64__)
  if (has_wide_instructions()) {
    multiply_widely<kColumns>(product);
    return;
  }
#endif
  multiply_portably<kColumns>(product);
}

template void multiply_tile<kProductColumns>(const float*, const TileShape&, const double*,
                                             const double*, double*, double*);
template void multiply_tile<kProductColumns>(const double*, const TileShape&, const double*,
                                             const double*, double*, double*);
template void multiply_tile<kFewProductColumns>(const float*, const TileShape&, const double*,
                                                const double*, double*, double*);
template void multiply_tile<kFewProductColumns>(const double*, const TileShape&, const double*,
                                                const double*, double*, double*);

}  // namespace radiosity

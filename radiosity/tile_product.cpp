#include "radiosity/tile_product.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

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

template <typename Entry>
void multiply_portably(const TileProduct<Entry>& p) {
  using Tile = Eigen::Matrix<Entry, Eigen::Dynamic, Eigen::Dynamic>;
  const Eigen::MatrixXd g =
      Eigen::Map<const Tile>(p.tile, p.shape.n_rows, p.shape.n_columns).template cast<double>();
  const Eigen::Map<const RowBlock> x_rows(p.x_rows, p.shape.n_rows, kProductColumns);
  const Eigen::Map<const RowBlock> x_columns(p.x_columns, p.shape.n_columns, kProductColumns);
  Eigen::Map<RowBlock>(p.above, p.shape.n_rows, kProductColumns).noalias() += g * x_columns;
  Eigen::Map<RowBlock>(p.below, p.shape.n_columns, kProductColumns).noalias() +=
      g.transpose() * x_rows;
}

#if defined(__x86_64__)

bool has_wide_instructions() {
  static const bool has = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  return has;
}

/// The eight columns of one row in two registers.
struct Row {
  __m256d low;
  __m256d high;
};

[[gnu::target("avx2,fma"), gnu::always_inline]] inline Row load(const double* row) {
  return {_mm256_loadu_pd(row), _mm256_loadu_pd(row + 4)};
}

[[gnu::target("avx2,fma"), gnu::always_inline]] inline void store(const Row& row, double* place) {
  _mm256_storeu_pd(place, row.low);
  _mm256_storeu_pd(place + 4, row.high);
}

/// sum + factor * row
[[gnu::target("avx2,fma"), gnu::always_inline]] inline Row add(const Row& sum, __m256d factor,
                                                               const Row& row) {
  return {_mm256_fmadd_pd(factor, row.low, sum.low), _mm256_fmadd_pd(factor, row.high, sum.high)};
}

template <typename Entry>
[[gnu::target("avx2,fma")]] void multiply_widely(const TileProduct<Entry>& p) {
  const Row zero = {_mm256_setzero_pd(), _mm256_setzero_pd()};
  Index j = 0;
  // Two columns of the tile at once, so that rows are loaded and stored half as often.
  for (; j + 1 < p.shape.n_columns; j += 2) {
    const Entry* g = p.tile + j * p.shape.n_rows;
    const Row in = load(p.x_columns + kProductColumns * j);
    const Row next_in = load(p.x_columns + kProductColumns * (j + 1));
    Row sum = zero;
    Row next_sum = zero;
    for (Index i = 0; i < p.shape.n_rows; ++i) {
      const __m256d entry = _mm256_set1_pd(static_cast<double>(g[i]));
      const __m256d next_entry = _mm256_set1_pd(static_cast<double>(g[i + p.shape.n_rows]));
      double* out = p.above + kProductColumns * i;
      store(add(add(load(out), entry, in), next_entry, next_in), out);
      const Row row = load(p.x_rows + kProductColumns * i);
      sum = add(sum, entry, row);
      next_sum = add(next_sum, next_entry, row);
    }
    const __m256d one = _mm256_set1_pd(1);
    double* out = p.below + kProductColumns * j;
    store(add(load(out), one, sum), out);
    store(add(load(out + kProductColumns), one, next_sum), out + kProductColumns);
  }
  if (j == p.shape.n_columns) return;
  multiply_portably(TileProduct<Entry>{p.tile + j * p.shape.n_rows,
                                       {p.shape.n_rows, 1},
                                       p.x_rows,
                                       p.x_columns + kProductColumns * j,
                                       p.above,
                                       p.below + kProductColumns * j});
}

#endif

template <typename Entry>
void multiply(const TileProduct<Entry>& product) {
#if defined(__x86_64__)
  if (has_wide_instructions()) {
    multiply_widely(product);
    return;
  }
#endif
  multiply_portably(product);
}

}  // namespace

void multiply_tile(const float* tile, const TileShape& shape, const double* x_rows,
                   const double* x_columns, double* above, double* below) {
  multiply(TileProduct<float>{tile, shape, x_rows, x_columns, above, below});
}

void multiply_tile(const double* tile, const TileShape& shape, const double* x_rows,
                   const double* x_columns, double* above, double* below) {
  multiply(TileProduct<double>{tile, shape, x_rows, x_columns, above, below});
}

}  // namespace radiosity

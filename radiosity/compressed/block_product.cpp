#include "radiosity/compressed/block_product.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include "radiosity/base/wide_instructions.h"

namespace radiosity {
namespace {

template <int kColumns>
void add_portably(const SmallMatrix& m, const double* x, double* y) {
  const float* number = m.numbers;
  for (int r = 0; r < m.n_rows; ++r) {
    for (int k = 0; k < m.n_columns; ++k) {
      const double factor = *number++;
      for (int c = 0; c < kColumns; ++c) y[r * kColumns + c] += factor * x[k * kColumns + c];
    }
  }
}

template <int kColumns>
void add_transposed_portably(const SmallMatrix& m, const double* x, double* y) {
  const float* number = m.numbers;
  for (int r = 0; r < m.n_rows; ++r) {
    for (int k = 0; k < m.n_columns; ++k) {
      const double factor = *number++;
      for (int c = 0; c < kColumns; ++c) y[k * kColumns + c] += factor * x[r * kColumns + c];
    }
  }
}

#if defined(__x86_64__)

/// Registers of a row.
template <int kColumns>
inline constexpr int kParts = kColumns / 4;

[[gnu::target("avx2,fma"), gnu::always_inline]] inline __m256d spread(const float* number) {
  return _mm256_cvtps_pd(_mm_broadcast_ss(number));
}

template <int kColumns>
[[gnu::target("avx2,fma")]] void add_widely(const SmallMatrix& m, const double* x, double* y) {
  const float* number = m.numbers;
  for (int r = 0; r < m.n_rows; ++r, y += kColumns) {
    __m256d sum[kParts<kColumns>];
    for (int p = 0; p < kParts<kColumns>; ++p) sum[p] = _mm256_loadu_pd(y + 4 * p);
    for (int k = 0; k < m.n_columns; ++k) {
      const __m256d factor = spread(number++);
      for (int p = 0; p < kParts<kColumns>; ++p) {
        sum[p] = _mm256_fmadd_pd(factor, _mm256_loadu_pd(x + k * kColumns + 4 * p), sum[p]);
      }
    }
    for (int p = 0; p < kParts<kColumns>; ++p) _mm256_storeu_pd(y + 4 * p, sum[p]);
  }
}

template <int kColumns>
[[gnu::target("avx2,fma")]] void add_transposed_widely(const SmallMatrix& m, const double* x,
                                                       double* y) {
  const float* number = m.numbers;
  for (int r = 0; r < m.n_rows; ++r, x += kColumns) {
    __m256d row[kParts<kColumns>];
    for (int p = 0; p < kParts<kColumns>; ++p) row[p] = _mm256_loadu_pd(x + 4 * p);
    for (int k = 0; k < m.n_columns; ++k) {
      const __m256d factor = spread(number++);
      for (int p = 0; p < kParts<kColumns>; ++p) {
        double* place = y + k * kColumns + 4 * p;
        _mm256_storeu_pd(place, _mm256_fmadd_pd(factor, row[p], _mm256_loadu_pd(place)));
      }
    }
  }
}

#endif

}  // namespace

template <int kColumns>
void add_product(const SmallMatrix& m, const double* x, double* y) {
#if defined(__x86_64__)
  if constexpr (kColumns > 1) {
    if (has_wide_instructions()) return add_widely<kColumns>(m, x, y);
  }
#endif
  add_portably<kColumns>(m, x, y);
}

template <int kColumns>
void add_transposed_product(const SmallMatrix& m, const double* x, double* y) {
#if defined(__x86_64__)
  if constexpr (kColumns > 1) {
    if (has_wide_instructions()) return add_transposed_widely<kColumns>(m, x, y);
  }
#endif
  add_transposed_portably<kColumns>(m, x, y);
}

template void add_product<1>(const SmallMatrix&, const double*, double*);
template void add_product<kFewColumns>(const SmallMatrix&, const double*, double*);
template void add_product<kManyColumns>(const SmallMatrix&, const double*, double*);
template void add_transposed_product<1>(const SmallMatrix&, const double*, double*);
template void add_transposed_product<kFewColumns>(const SmallMatrix&, const double*, double*);
template void add_transposed_product<kManyColumns>(const SmallMatrix&, const double*, double*);

}  // namespace radiosity

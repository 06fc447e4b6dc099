#include "radiosity/compressed/block_product.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include <cstdint>

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

/// Calls visit(matrix, first) for the steps of a stair; `first` is the first of their rows.
template <typename Visit>
[[gnu::always_inline]] inline void for_steps(const StairMatrix& m, const Visit& visit) {
  SmallMatrix step{m.numbers, 0, 0};
  for (int k = 0, first = 0; k < m.n_steps; ++k) {
    step.n_rows = m.steps[k].n_rows;
    step.n_columns = m.steps[k].n_columns;
    visit(step, first);
    step.numbers += step.n_rows * step.n_columns;
    first += step.n_rows;
  }
}

#if defined(__x86_64__)

constexpr int kLanes = 4;  // numbers of a register

[[gnu::target("avx2,fma"), gnu::always_inline]] inline __m256d spread(const float* number) {
  return _mm256_cvtps_pd(_mm_broadcast_ss(number));
}

/// For matrices times four columns and multiples of that: a register for four of them.
template <int kColumns>
struct Wide {
  static constexpr int kParts = kColumns / kLanes;

  /// Sums of so many rows at a time, one after the other and each in the order of the columns.
  template <int kRows>
  [[gnu::target("avx2,fma"), gnu::always_inline]] static inline void add_rows(const float* numbers,
                                                                              int n_columns,
                                                                              const double* x,
                                                                              double* y) {
    __m256d sum[kRows * kParts];
    for (int i = 0; i < kRows * kParts; ++i) sum[i] = _mm256_loadu_pd(y + kLanes * i);
    for (int k = 0; k < n_columns; ++k, x += kColumns) {
      for (int r = 0; r < kRows; ++r) {
        const __m256d factor = spread(numbers + r * n_columns + k);
        for (int p = 0; p < kParts; ++p) {
          sum[r * kParts + p] =
              _mm256_fmadd_pd(factor, _mm256_loadu_pd(x + kLanes * p), sum[r * kParts + p]);
        }
      }
    }
    for (int i = 0; i < kRows * kParts; ++i) _mm256_storeu_pd(y + kLanes * i, sum[i]);
  }

  [[gnu::target("avx2,fma"), gnu::always_inline]] static inline void add(const SmallMatrix& m,
                                                                         const double* x,
                                                                         double* y) {
    int r = 0;
    for (; r + 2 <= m.n_rows; r += 2) {
      add_rows<2>(m.numbers + r * m.n_columns, m.n_columns, x, y + r * kColumns);
    }
    if (r < m.n_rows) add_rows<1>(m.numbers + r * m.n_columns, m.n_columns, x, y + r * kColumns);
  }

  /// Likewise of so many columns, whose sums stay in registers.
  template <int kTogether>
  [[gnu::target("avx2,fma"), gnu::always_inline]] static inline void add_columns(
      const SmallMatrix& m, int first, const double* x, double* y) {
    __m256d sum[kTogether * kParts];
    y += first * kColumns;
    for (int i = 0; i < kTogether * kParts; ++i) sum[i] = _mm256_loadu_pd(y + kLanes * i);
    const float* numbers = m.numbers + first;
    for (int r = 0; r < m.n_rows; ++r, numbers += m.n_columns, x += kColumns) {
      for (int k = 0; k < kTogether; ++k) {
        const __m256d factor = spread(numbers + k);
        for (int p = 0; p < kParts; ++p) {
          sum[k * kParts + p] =
              _mm256_fmadd_pd(factor, _mm256_loadu_pd(x + kLanes * p), sum[k * kParts + p]);
        }
      }
    }
    for (int i = 0; i < kTogether * kParts; ++i) _mm256_storeu_pd(y + kLanes * i, sum[i]);
  }

  [[gnu::target("avx2,fma"), gnu::always_inline]] static inline void add_transposed(
      const SmallMatrix& m, const double* x, double* y) {
    int k = 0;
    for (; k + 4 <= m.n_columns; k += 4) add_columns<4>(m, k, x, y);
    for (; k + 2 <= m.n_columns; k += 2) add_columns<2>(m, k, x, y);
    if (k < m.n_columns) add_columns<1>(m, k, x, y);
  }
};

/// For matrices times one column: a register for four numbers of a row.
template <>
struct Wide<1> {
  [[gnu::target("avx2,fma"), gnu::always_inline]] static inline __m128i mask(int n) {
    return _mm_cmpgt_epi32(_mm_set1_epi32(n), _mm_setr_epi32(0, 1, 2, 3));
  }

  /// The products of a row, in four sums; `rest` marks those beyond multiples of four columns.
  [[gnu::target("avx2,fma"), gnu::always_inline]] static inline __m256d sums(const float* row,
                                                                             int n_columns,
                                                                             __m128i rest,
                                                                             const double* x) {
    __m256d sum = _mm256_setzero_pd();
    int k = 0;
    for (; k + kLanes <= n_columns; k += kLanes) {
      sum = _mm256_fmadd_pd(_mm256_cvtps_pd(_mm_loadu_ps(row + k)), _mm256_loadu_pd(x + k), sum);
    }
    if (k == n_columns) return sum;
    const __m256d numbers = _mm256_cvtps_pd(_mm_maskload_ps(row + k, rest));
    return _mm256_fmadd_pd(numbers, _mm256_maskload_pd(x + k, _mm256_cvtepi32_epi64(rest)), sum);
  }

  [[gnu::target("avx2,fma"), gnu::always_inline]] static inline void add(const SmallMatrix& m,
                                                                         const double* x,
                                                                         double* y) {
    const __m128i rest = mask(m.n_columns % kLanes);
    const float* row = m.numbers;
    int r = 0;
    for (; r + 2 <= m.n_rows; r += 2, row += 2 * m.n_columns) {
      const __m256d pairs = _mm256_hadd_pd(sums(row, m.n_columns, rest, x),
                                           sums(row + m.n_columns, m.n_columns, rest, x));
      const __m128d both =
          _mm_add_pd(_mm256_castpd256_pd128(pairs), _mm256_extractf128_pd(pairs, 1));
      _mm_storeu_pd(y + r, _mm_add_pd(_mm_loadu_pd(y + r), both));
    }
    if (r == m.n_rows) return;
    const __m256d last = sums(row, m.n_columns, rest, x);
    const __m128d half = _mm_add_pd(_mm256_castpd256_pd128(last), _mm256_extractf128_pd(last, 1));
    y[r] += _mm_cvtsd_f64(_mm_hadd_pd(half, half));
  }

  [[gnu::target("avx2,fma"), gnu::always_inline]] static inline void add_transposed(
      const SmallMatrix& m, const double* x, double* y) {
    int k = 0;
    for (; k + kLanes <= m.n_columns; k += kLanes) {
      __m256d sum = _mm256_loadu_pd(y + k);
      const float* numbers = m.numbers + k;
      for (int r = 0; r < m.n_rows; ++r, numbers += m.n_columns) {
        sum = _mm256_fmadd_pd(_mm256_broadcast_sd(x + r), _mm256_cvtps_pd(_mm_loadu_ps(numbers)),
                              sum);
      }
      _mm256_storeu_pd(y + k, sum);
    }
    if (k == m.n_columns) return;
    const __m128i rest = mask(m.n_columns - k);
    const __m256i places = _mm256_cvtepi32_epi64(rest);
    __m256d sum = _mm256_maskload_pd(y + k, places);
    const float* numbers = m.numbers + k;
    for (int r = 0; r < m.n_rows; ++r, numbers += m.n_columns) {
      sum = _mm256_fmadd_pd(_mm256_broadcast_sd(x + r),
                            _mm256_cvtps_pd(_mm_maskload_ps(numbers, rest)), sum);
    }
    _mm256_maskstore_pd(y + k, places, sum);
  }
};

template <int kColumns>
[[gnu::target("avx2,fma")]] void add_widely(const SmallMatrix& m, const double* x, double* y) {
  Wide<kColumns>::add(m, x, y);
}

template <int kColumns>
[[gnu::target("avx2,fma")]] void add_widely(const StairMatrix& m, const double* x, double* y) {
  SmallMatrix step{m.numbers, 0, 0};
  for (int k = 0; k < m.n_steps; ++k) {
    step.n_rows = m.steps[k].n_rows;
    step.n_columns = m.steps[k].n_columns;
    Wide<kColumns>::add(step, x, y);
    step.numbers += step.n_rows * step.n_columns;
    y += step.n_rows * kColumns;
  }
}

template <int kColumns>
[[gnu::target("avx2,fma")]] void add_transposed_widely(const SmallMatrix& m, const double* x,
                                                       double* y) {
  Wide<kColumns>::add_transposed(m, x, y);
}

template <int kColumns>
[[gnu::target("avx2,fma")]] void add_transposed_widely(const StairMatrix& m, const double* x,
                                                       double* y) {
  SmallMatrix step{m.numbers, 0, 0};
  for (int k = 0; k < m.n_steps; ++k) {
    step.n_rows = m.steps[k].n_rows;
    step.n_columns = m.steps[k].n_columns;
    Wide<kColumns>::add_transposed(step, x, y);
    step.numbers += step.n_rows * step.n_columns;
    x += step.n_rows * kColumns;
  }
}

#endif

}  // namespace

template <int kColumns>
void add_product(const SmallMatrix& m, const double* x, double* y) {
#if defined(__x86_64__)
  if (has_wide_instructions()) return add_widely<kColumns>(m, x, y);
#endif
  add_portably<kColumns>(m, x, y);
}

template <int kColumns>
void add_product(const StairMatrix& m, const double* x, double* y) {
#if defined(__x86_64__)
  if (has_wide_instructions()) return add_widely<kColumns>(m, x, y);
#endif
  for_steps(m, [&](const SmallMatrix& step, int first) {
    add_portably<kColumns>(step, x, y + first * kColumns);
  });
}

template <int kColumns>
void add_transposed_product(const SmallMatrix& m, const double* x, double* y) {
#if defined(__x86_64__)
  if (has_wide_instructions()) return add_transposed_widely<kColumns>(m, x, y);
#endif
  add_transposed_portably<kColumns>(m, x, y);
}

template <int kColumns>
void add_transposed_product(const StairMatrix& m, const double* x, double* y) {
#if defined(__x86_64__)
  if (has_wide_instructions()) return add_transposed_widely<kColumns>(m, x, y);
#endif
  for_steps(m, [&](const SmallMatrix& step, int first) {
    add_transposed_portably<kColumns>(step, x + first * kColumns, y);
  });
}

template void add_product<1>(const SmallMatrix&, const double*, double*);
template void add_product<kFewColumns>(const SmallMatrix&, const double*, double*);
template void add_product<kManyColumns>(const SmallMatrix&, const double*, double*);
template void add_transposed_product<1>(const SmallMatrix&, const double*, double*);
template void add_transposed_product<kFewColumns>(const SmallMatrix&, const double*, double*);
template void add_transposed_product<kManyColumns>(const SmallMatrix&, const double*, double*);
template void add_product<1>(const StairMatrix&, const double*, double*);
template void add_product<kFewColumns>(const StairMatrix&, const double*, double*);
template void add_product<kManyColumns>(const StairMatrix&, const double*, double*);
template void add_transposed_product<1>(const StairMatrix&, const double*, double*);
template void add_transposed_product<kFewColumns>(const StairMatrix&, const double*, double*);
template void add_transposed_product<kManyColumns>(const StairMatrix&, const double*, double*);

}  // namespace radiosity

#pragma once

#include <array>

namespace radiosity {

/// Columns that go through a block at once, if there are some.
inline constexpr int kManyColumns = 8;
inline constexpr int kFewColumns = 4;

/// A small matrix, row after row.
struct SmallMatrix {
  const float* numbers;
  int n_rows;
  int n_columns;
};

/// One whose rows have different lengths, row after row: those of each step have the same, from the
/// first column on.
struct StairMatrix {
  struct Step {
    int n_rows;
    int n_columns;
  };
  static constexpr int kMostSteps = 5;
  const float* numbers;
  int n_steps;
  std::array<Step, kMostSteps> steps;
};

/// y += M x for x of n_columns x kColumns and y of n_rows x kColumns, row after row, which don't
/// overlap; in double precision, with AVX2 and FMA where the processor has them. For 1, 4 and 8
/// columns.
template <int kColumns>
void add_product(const SmallMatrix& m, const double* x, double* y);
template <int kColumns>
void add_product(const StairMatrix& m, const double* x, double* y);

/// y += Mᵀ x in the same way, for x of n_rows and y of n_columns rows.
template <int kColumns>
void add_transposed_product(const SmallMatrix& m, const double* x, double* y);
template <int kColumns>
void add_transposed_product(const StairMatrix& m, const double* x, double* y);

}  // namespace radiosity

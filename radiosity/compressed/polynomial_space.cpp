#include "radiosity/compressed/polynomial_space.h"

#include <algorithm>
#include <map>

namespace radiosity {

PolynomialSpace::PolynomialSpace(int dimension, int degree)
    : dimension_(dimension), degree_(degree), counts_{1}, factors_{{0, 0}} {
  // Each monomial once: as one of a degree less times a coordinate that is none of its earlier
  // ones.
  std::map<std::vector<int>, int> numbers;
  std::vector<std::vector<int>> exponents{std::vector<int>(dimension, 0)};
  numbers[exponents[0]] = 0;
  int begin = 0;
  for (int d = 1; d <= degree; ++d) {
    const int end = static_cast<int>(exponents.size());
    for (int lower = begin; lower < end; ++lower) {
      for (int k = 0; k < dimension; ++k) {
        std::vector<int> next = exponents[lower];
        ++next[k];
        if (!numbers.emplace(next, static_cast<int>(exponents.size())).second) continue;
        exponents.push_back(next);
        factors_.push_back({lower, k});
      }
    }
    begin = end;
    counts_.push_back(static_cast<int>(exponents.size()));
  }
  by_.assign(exponents.size(), std::vector<int>(dimension, -1));
  for (std::size_t m = 0; m < exponents.size(); ++m) {
    for (int k = 0; k < dimension; ++k) {
      std::vector<int> next = exponents[m];
      ++next[k];
      const auto found = numbers.find(next);
      if (found != numbers.end()) by_[m][k] = found->second;
    }
  }
}

void PolynomialSpace::evaluate(const double* point, double* values) const {
  values[0] = 1;
  for (int m = 1; m < size(); ++m) {
    values[m] = values[factors_[m].monomial] * point[factors_[m].coordinate];
  }
}

Eigen::MatrixXd PolynomialSpace::substituted(const Eigen::MatrixXd& map,
                                             const PolynomialSpace& inner) const {
  const int degree = std::min(degree_, inner.degree_);
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(size(degree), inner.size(degree));
  result(0, 0) = 1;
  for (int m = 1; m < size(degree); ++m) {
    const Factor factor = factors_[m];
    for (int n = 0; n < inner.size(degree); ++n) {
      const double coefficient = result(factor.monomial, n);
      if (coefficient == 0) continue;
      result(m, n) += coefficient * map(factor.coordinate, 0);
      for (int k = 0; k < inner.dimension_; ++k) {
        const int product = inner.by_[n][k];
        if (product >= 0 && product < inner.size(degree)) {
          result(m, product) += coefficient * map(factor.coordinate, 1 + k);
        }
      }
    }
  }
  return result;
}

}  // namespace radiosity

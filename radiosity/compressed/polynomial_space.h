#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace radiosity {

/// The monomials z_1^e1 z_2^e2 ... of `dimension` coordinates up to a degree, by rising degree: the
/// constant is the first.
class PolynomialSpace {
 public:
  PolynomialSpace(int dimension, int degree);

  [[nodiscard]] int dimension() const { return dimension_; }
  [[nodiscard]] int degree() const { return degree_; }
  /// Number of monomials, and of those up to a degree.
  [[nodiscard]] int size() const { return counts_.back(); }
  [[nodiscard]] int size(int degree) const { return counts_[degree]; }

  /// All monomials at a point of `dimension` coordinates.
  void evaluate(const double* point, double* values) const;

  /// The monomials of this space, as far as `inner` has their degrees, as polynomials of the
  /// coordinates of another, of which these are affine functions: `map` is dimension x (1 +
  /// inner.dimension), constants first. Row k holds the coefficients of monomial k: size(degree) x
  /// inner.size(degree) for the lower degree of the two.
  [[nodiscard]] Eigen::MatrixXd substituted(const Eigen::MatrixXd& map,
                                            const PolynomialSpace& inner) const;

 private:
  struct Factor {
    int monomial;    // of one degree less
    int coordinate;  // that it is multiplied by
  };
  int dimension_;
  int degree_;
  std::vector<int> counts_;           // per degree
  std::vector<Factor> factors_;       // per monomial but the constant, [0] unused
  std::vector<std::vector<int>> by_;  // by_[monomial][coordinate]: their product, -1 = too high
};

}  // namespace radiosity

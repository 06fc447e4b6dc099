#pragma once

#include <Eigen/Core>

#include "radiosity/operator/transport.h"

namespace radiosity {

/// F x, n x k, for columns of which many are nearly combinations of few, such as bands of a
/// spectrum: column c is off by at most `tolerance`[c] in the energy norm. The columns are written
/// as combinations of an orthonormal basis (Gram-Schmidt with pivoting), to which F is applied.
/// Below eight columns, and where their inner products tell that the basis would be more than three
/// fifths of them, it is the plain product.
Eigen::MatrixXd apply_by_basis(const Transport& transport, Eigen::MatrixXd x,
                               const Eigen::VectorXd& tolerance);

/// Energy norms sqrt(Σ A x²) of the columns of x, k.
Eigen::VectorXd energy_norms(const Transport& transport, const Eigen::MatrixXd& x);

}  // namespace radiosity

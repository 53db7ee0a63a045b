#pragma once
// The sign of a square matrix: eigenvalues in the right half plane become +1, in the left -1.
//
// Equation   Z <- (c Z + (c Z)^-1)/2, Z0 = M, c = |det Z|^(-1/n)
// Source     R. Byers, Linear Algebra Appl. 85 (1987) 267: "Solving the algebraic Riccati equation
//            with the matrix sign function". Real arithmetic and matrix inverses only: about ten
//            times faster than an ordered Schur form at 100 states.
// Failure    nothing is returned when the iteration does not settle: an eigenvalue lies on the
//            imaginary axis, as far as rounding can tell.
// Thread     any; pure.

#include <Eigen/Core>
#include <optional>

namespace levitas::synthesis {

[[nodiscard]] std::optional<Eigen::MatrixXd> MatrixSign(const Eigen::MatrixXd& matrix);

}  // namespace levitas::synthesis

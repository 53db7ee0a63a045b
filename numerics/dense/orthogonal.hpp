#pragma once
// Orthogonal factors of a Hessenberg form and of a QR factorisation as plain matrices. Eigen holds
// them as a sequence of reflections, all of whose members every source would make anew.
//
// Thread  any; pure. Failure: none; `qr` and `reduced` hold a factorisation.

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

namespace levitas::numerics {

/// Q of A = Q H Q'.
[[nodiscard]] Eigen::MatrixXd OrthogonalFactor(
    const Eigen::HessenbergDecomposition<Eigen::MatrixXd>& reduced);

/// The first `count` columns of Q of A P = Q R.
[[nodiscard]] Eigen::MatrixXd OrthogonalColumns(
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd>& qr, Eigen::Index count);

}  // namespace levitas::numerics

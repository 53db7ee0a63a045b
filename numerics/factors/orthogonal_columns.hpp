#pragma once
// Orthogonal factor of a QR factorisation as a plain matrix. Eigen holds it as a sequence of
// reflections, all of whose members every source would make anew.
//
// Thread  any; pure. Failure: none; `qr` holds a factorisation.

#include <Eigen/QR>

namespace levitas::numerics {

/// The first `count` columns of Q of A P = Q R.
[[nodiscard]] Eigen::MatrixXd OrthogonalColumns(
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd>& qr, Eigen::Index count);

}  // namespace levitas::numerics

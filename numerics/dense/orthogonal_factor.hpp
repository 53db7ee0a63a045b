#pragma once
// Orthogonal factor of a Hessenberg form as a plain matrix. Eigen holds it as a sequence of
// reflections, all of whose members every source would make anew. That of a QR factorisation:
// numerics/factors/orthogonal_columns.hpp.
//
// Thread  any; pure. Failure: none; `reduced` holds a factorisation.

#include <Eigen/Eigenvalues>

namespace levitas::numerics {

/// Q of A = Q H Q'.
[[nodiscard]] Eigen::MatrixXd OrthogonalFactor(
    const Eigen::HessenbergDecomposition<Eigen::MatrixXd>& reduced);

}  // namespace levitas::numerics

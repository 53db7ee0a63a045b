#include "numerics/dense/orthogonal_factor.hpp"

#include "numerics/dense/eigenvalues.hpp"
#include "numerics/dense/factorisations.hpp"

namespace levitas::numerics {

Eigen::MatrixXd OrthogonalFactor(const Eigen::HessenbergDecomposition<Eigen::MatrixXd>& reduced) {
  return reduced.matrixQ();
}

}  // namespace levitas::numerics

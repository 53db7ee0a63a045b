#include "numerics/dense/orthogonal.hpp"

#include "numerics/dense/eigenvalues.hpp"
#include "numerics/dense/factorisations.hpp"

namespace levitas::numerics {

Eigen::MatrixXd OrthogonalFactor(const Eigen::HessenbergDecomposition<Eigen::MatrixXd>& reduced) {
  return reduced.matrixQ();
}

Eigen::MatrixXd OrthogonalColumns(const Eigen::ColPivHouseholderQR<Eigen::MatrixXd>& qr,
                                  Eigen::Index count) {
  return qr.householderQ() * Eigen::MatrixXd::Identity(qr.rows(), count);
}

}  // namespace levitas::numerics

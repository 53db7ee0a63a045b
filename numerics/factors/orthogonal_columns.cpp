#include "numerics/factors/orthogonal_columns.hpp"

#include "numerics/factors/factors.hpp"

namespace levitas::numerics {

Eigen::MatrixXd OrthogonalColumns(const Eigen::ColPivHouseholderQR<Eigen::MatrixXd>& qr,
                                  Eigen::Index count) {
  return qr.householderQ() * Eigen::MatrixXd::Identity(qr.rows(), count);
}

}  // namespace levitas::numerics

#include "numerics/dense/exponential.hpp"

#include "numerics/dense/factorisations.hpp"

namespace Eigen::internal {

template void matrix_exp_compute(const MatrixXd&, MatrixXd&, true_type);

}  // namespace Eigen::internal

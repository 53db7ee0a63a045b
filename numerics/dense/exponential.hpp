#pragma once
// The exponential of a real matrix, `a.exp()` of a MatrixXd, compiled once: see
// numerics/dense/factorisations.hpp for how and why.

#include <Eigen/Core>
#include <unsupported/Eigen/MatrixFunctions>

namespace Eigen::internal {

extern template void matrix_exp_compute(const MatrixXd&, MatrixXd&, true_type);

}  // namespace Eigen::internal

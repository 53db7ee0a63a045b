#pragma once
// The diagonal of D with which rows of D M D^-1 are balanced against columns (E. E. Osborne, J. ACM
// 7, 1960); 1 behind the first `perturbations` entries. Thread: any; pure.

#include <Eigen/Core>

namespace levitas::uncertainty {

[[nodiscard]] Eigen::VectorXd BalancingScale(const Eigen::MatrixXcd& m, Eigen::Index perturbations);

}  // namespace levitas::uncertainty

#pragma once
// D M D^-1 with rows balanced against columns (E. E. Osborne, J. ACM 7, 1960), D = diag(e^l) free
// in the first `perturbations` entries. Thread: any; pure.

#include <Eigen/Core>

namespace levitas::uncertainty {

/// `l`: ln D, of all rows of M.
[[nodiscard]] Eigen::MatrixXcd Balanced(const Eigen::MatrixXcd& m, Eigen::Index perturbations,
                                        Eigen::VectorXd& l);

}  // namespace levitas::uncertainty

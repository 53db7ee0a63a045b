#pragma once
// LU with full pivoting, Cholesky of both kinds and QR, compiled once: see
// numerics/dense/factorisations.hpp for how and why. That one, which this header includes, has what
// a run needs besides: PartialPivLU, and LDLT of real matrices.

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>

#include "numerics/dense/factorisations.hpp"

namespace Eigen {

extern template void FullPivLU<MatrixXd>::computeInPlace();
extern template void FullPivLU<MatrixXcd>::computeInPlace();
extern template void FullPivLU<MatrixXd>::_solve_impl(const MatrixXd&, MatrixXd&) const;
extern template void FullPivLU<MatrixXcd>::_solve_impl(const MatrixXcd&, MatrixXcd&) const;

extern template LLT<MatrixXcd>& LLT<MatrixXcd>::compute(const EigenBase<MatrixXcd>&);
extern template LDLT<MatrixXcd>& LDLT<MatrixXcd>::compute(const EigenBase<MatrixXcd>&);
extern template void LLT<MatrixXd>::_solve_impl(const MatrixXd&, MatrixXd&) const;
extern template void LLT<MatrixXd>::_solve_impl(const VectorXd&, VectorXd&) const;

extern template void HouseholderQR<MatrixXd>::computeInPlace();
extern template void HouseholderQR<MatrixXd>::_solve_impl(const MatrixXd&, MatrixXd&) const;
extern template void ColPivHouseholderQR<MatrixXd>::computeInPlace();
extern template void ColPivHouseholderQR<MatrixXd>::_solve_impl(const VectorXd&, VectorXd&) const;

}  // namespace Eigen

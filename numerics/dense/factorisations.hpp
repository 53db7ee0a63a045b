#pragma once
// Factorisations of dense matrices (LU, Cholesky, QR), compiled once.
//
// Use     include this where such a class of Eigen is used, and name the library `dense`: the
//         compiler then calls the functions below instead of making them again in every source,
//         which costs seconds each. Nothing else changes, and without this header everything works.
// Covers  MatrixXd and MatrixXcd. Give LLT, LDLT and the solvers of eigenvalues an evaluated
//         matrix: for an expression, a type of its own, they are made anew.
// Limits  only members that Eigen defines outside their class; GCC makes the others in any case.
// Thread  any. Failure: as Eigen documents.

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>

namespace Eigen {

extern template void PartialPivLU<MatrixXd>::compute();
extern template void PartialPivLU<MatrixXcd>::compute();
extern template void FullPivLU<MatrixXd>::computeInPlace();
extern template void FullPivLU<MatrixXcd>::computeInPlace();
extern template void FullPivLU<MatrixXd>::_solve_impl(const MatrixXd&, MatrixXd&) const;
extern template void FullPivLU<MatrixXcd>::_solve_impl(const MatrixXcd&, MatrixXcd&) const;

extern template LLT<MatrixXd>& LLT<MatrixXd>::compute(const EigenBase<MatrixXd>&);
extern template LLT<MatrixXcd>& LLT<MatrixXcd>::compute(const EigenBase<MatrixXcd>&);
extern template LDLT<MatrixXd>& LDLT<MatrixXd>::compute(const EigenBase<MatrixXd>&);
extern template LDLT<MatrixXcd>& LDLT<MatrixXcd>::compute(const EigenBase<MatrixXcd>&);
extern template void LLT<MatrixXd>::_solve_impl(const MatrixXd&, MatrixXd&) const;
extern template void LLT<MatrixXd>::_solve_impl(const VectorXd&, VectorXd&) const;
extern template void LDLT<MatrixXd>::_solve_impl(const MatrixXd&, MatrixXd&) const;
extern template void LDLT<MatrixXd>::_solve_impl(const VectorXd&, VectorXd&) const;

extern template void HouseholderQR<MatrixXd>::computeInPlace();
extern template void HouseholderQR<MatrixXd>::_solve_impl(const MatrixXd&, MatrixXd&) const;
extern template void ColPivHouseholderQR<MatrixXd>::computeInPlace();
extern template void ColPivHouseholderQR<MatrixXd>::_solve_impl(const VectorXd&, VectorXd&) const;

}  // namespace Eigen

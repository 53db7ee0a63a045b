#pragma once
// Factorisations of dense matrices (LU, Cholesky), compiled once.
//
// Use     include this where such a class of Eigen is used, and name the library `dense`: the
//         compiler then calls the functions below instead of making them again in every source,
//         which costs seconds each. Nothing else changes, and without this header everything works.
// Covers  MatrixXd and MatrixXcd, as far as a run uses them: a first build waits for each one. The
//         others, full pivoting and QR among them: numerics/factors, which is used alike. Give LLT,
//         LDLT and the solvers of eigenvalues an evaluated matrix: for an expression, a type of
//         its own, they are made anew.
// Limits  only members that Eigen defines outside their class; GCC makes the others in any case.
// Thread  any. Failure: as Eigen documents.

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace Eigen {

extern template void PartialPivLU<MatrixXd>::compute();
extern template void PartialPivLU<MatrixXcd>::compute();
extern template LLT<MatrixXd>& LLT<MatrixXd>::compute(const EigenBase<MatrixXd>&);
extern template LDLT<MatrixXd>& LDLT<MatrixXd>::compute(const EigenBase<MatrixXd>&);
extern template void LDLT<MatrixXd>::_solve_impl(const MatrixXd&, MatrixXd&) const;
extern template void LDLT<MatrixXd>::_solve_impl(const VectorXd&, VectorXd&) const;

}  // namespace Eigen

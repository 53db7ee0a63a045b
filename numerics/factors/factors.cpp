#include "numerics/factors/factors.hpp"

namespace Eigen {

template void FullPivLU<MatrixXd>::computeInPlace();
template void FullPivLU<MatrixXcd>::computeInPlace();
template void FullPivLU<MatrixXd>::_solve_impl(const MatrixXd&, MatrixXd&) const;
template void FullPivLU<MatrixXcd>::_solve_impl(const MatrixXcd&, MatrixXcd&) const;

template LLT<MatrixXcd>& LLT<MatrixXcd>::compute(const EigenBase<MatrixXcd>&);
template LDLT<MatrixXcd>& LDLT<MatrixXcd>::compute(const EigenBase<MatrixXcd>&);
template void LLT<MatrixXd>::_solve_impl(const MatrixXd&, MatrixXd&) const;
template void LLT<MatrixXd>::_solve_impl(const VectorXd&, VectorXd&) const;

template void HouseholderQR<MatrixXd>::computeInPlace();
template void HouseholderQR<MatrixXd>::_solve_impl(const MatrixXd&, MatrixXd&) const;
template void ColPivHouseholderQR<MatrixXd>::computeInPlace();
template void ColPivHouseholderQR<MatrixXd>::_solve_impl(const VectorXd&, VectorXd&) const;

}  // namespace Eigen

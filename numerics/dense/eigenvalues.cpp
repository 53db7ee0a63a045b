#include "numerics/dense/eigenvalues.hpp"

#include "numerics/dense/factorisations.hpp"

namespace Eigen {

template EigenSolver<MatrixXd>& EigenSolver<MatrixXd>::compute(const EigenBase<MatrixXd>&, bool);
template MatrixXcd EigenSolver<MatrixXd>::eigenvectors() const;
template void HessenbergDecomposition<MatrixXd>::_compute(MatrixXd&, VectorXd&, RowVectorXd&);

template SelfAdjointEigenSolver<MatrixXd>& SelfAdjointEigenSolver<MatrixXd>::compute(
    const EigenBase<MatrixXd>&, int);
template SelfAdjointEigenSolver<MatrixXcd>& SelfAdjointEigenSolver<MatrixXcd>::compute(
    const EigenBase<MatrixXcd>&, int);
template GeneralizedSelfAdjointEigenSolver<MatrixXd>&
GeneralizedSelfAdjointEigenSolver<MatrixXd>::compute(const MatrixXd&, const MatrixXd&, int);

}  // namespace Eigen

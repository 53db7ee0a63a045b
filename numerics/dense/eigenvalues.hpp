#pragma once
// Eigenvalues and eigenvectors of real and of Hermitian matrices, compiled once: see
// numerics/dense/factorisations.hpp for how and why. Those of complex matrices: numerics/spectra.

#include <Eigen/Eigenvalues>

namespace Eigen {

extern template EigenSolver<MatrixXd>& EigenSolver<MatrixXd>::compute(const EigenBase<MatrixXd>&,
                                                                      bool);
extern template MatrixXcd EigenSolver<MatrixXd>::eigenvectors() const;
extern template void HessenbergDecomposition<MatrixXd>::_compute(MatrixXd&, VectorXd&,
                                                                 RowVectorXd&);

extern template SelfAdjointEigenSolver<MatrixXd>& SelfAdjointEigenSolver<MatrixXd>::compute(
    const EigenBase<MatrixXd>&, int);
extern template SelfAdjointEigenSolver<MatrixXcd>& SelfAdjointEigenSolver<MatrixXcd>::compute(
    const EigenBase<MatrixXcd>&, int);
extern template GeneralizedSelfAdjointEigenSolver<MatrixXd>&
GeneralizedSelfAdjointEigenSolver<MatrixXd>::compute(const MatrixXd&, const MatrixXd&, int);

}  // namespace Eigen

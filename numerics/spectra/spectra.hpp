#pragma once
// Singular values of real and complex matrices, eigenvalues of complex ones, compiled once: see
// numerics/dense/factorisations.hpp for how and why.

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

namespace Eigen {

extern template JacobiSVD<MatrixXd>& JacobiSVD<MatrixXd>::compute(const MatrixXd&, unsigned);
extern template JacobiSVD<MatrixXcd>& JacobiSVD<MatrixXcd>::compute(const MatrixXcd&, unsigned);
extern template BDCSVD<MatrixXd>& BDCSVD<MatrixXd>::compute(const MatrixXd&, unsigned);

extern template ComplexEigenSolver<MatrixXcd>& ComplexEigenSolver<MatrixXcd>::compute(
    const EigenBase<MatrixXcd>&, bool);
extern template GeneralizedSelfAdjointEigenSolver<MatrixXcd>&
GeneralizedSelfAdjointEigenSolver<MatrixXcd>::compute(const MatrixXcd&, const MatrixXcd&, int);

}  // namespace Eigen

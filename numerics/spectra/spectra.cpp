#include "numerics/spectra/spectra.hpp"

#include "numerics/dense/eigenvalues.hpp"
#include "numerics/factors/factors.hpp"

namespace Eigen {

template JacobiSVD<MatrixXd>& JacobiSVD<MatrixXd>::compute(const MatrixXd&, unsigned);
template JacobiSVD<MatrixXcd>& JacobiSVD<MatrixXcd>::compute(const MatrixXcd&, unsigned);
template BDCSVD<MatrixXd>& BDCSVD<MatrixXd>::compute(const MatrixXd&, unsigned);

template ComplexEigenSolver<MatrixXcd>& ComplexEigenSolver<MatrixXcd>::compute(
    const EigenBase<MatrixXcd>&, bool);
template GeneralizedSelfAdjointEigenSolver<MatrixXcd>&
GeneralizedSelfAdjointEigenSolver<MatrixXcd>::compute(const MatrixXcd&, const MatrixXcd&, int);

}  // namespace Eigen

#pragma once
// An upper bound of mu with real perturbations: D scales them, G uses that they are real.
//
// Equation   M^ = D M D^-1, H = M^* M^ + j (G M^ - M^* G), mu <= sqrt(largest eigenvalue of H) for
//            every D = diag(e^l), G = diag(g) real, with l = g = 0 behind the perturbations: M. K.
//            H. Fan, A. L. Tits, J. C. Doyle, IEEE Trans. Automatic Control 36 (1991) 25.
// Method     descent along l and g (BFGS) of a smooth maximum of the eigenvalues, ln(sum e^{t x})/t
//            with t growing, from the balanced D and G = 0: never above ComplexMu. What is returned
//            is the eigenvalue itself, a bound wherever the descent ended.
// Structure  the first `perturbations` rows and columns are real scalars, the rest one full block.
// Shares     no line with the synthesis' bounds. Thread: any; pure.

#include <Eigen/Core>

namespace levitas::uncertainty {

/// Ends as soon as the bound is at or below `enough`.
[[nodiscard]] double MixedMu(const Eigen::MatrixXcd& m, Eigen::Index perturbations,
                             double enough = 0.0);

}  // namespace levitas::uncertainty

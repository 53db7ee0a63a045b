#pragma once
// Stabilising solutions of continuous Riccati and Lyapunov equations.
//
// Equation   A' X + X A - X G X + Q = 0, G and Q symmetric (G may be indefinite, as in H-infinity)
//            A' X + X A + Q = 0
// Method     invariant subspace of the Hamiltonian [A -G; -Q -A'] by its matrix sign (Byers 1987),
//            then corrections by the same method from the residual, until the residual is rounding.
// Failure    nothing is returned: no stabilising solution (eigenvalues of the Hamiltonian on the
//            imaginary axis), or one whose residual stays above `kRiccatiResidual`.
// Thread     any; pure.

#include <Eigen/Core>
#include <optional>

namespace levitas::synthesis {

/// Largest residual, as a share of the sum of the norms of the equation's terms. Rounding of 100
/// states leaves about 1e-12; a solution above 1e-7 has lost the digits that the norm check needs.
inline constexpr double kRiccatiResidual = 1e-7;

/// `q_terms`: norm of the larger terms when Q was computed as their difference. Entries of Q no
/// larger than the rounding error of these terms count as zero.
[[nodiscard]] std::optional<Eigen::MatrixXd> SolveRiccati(const Eigen::MatrixXd& A,
                                                          const Eigen::MatrixXd& G,
                                                          const Eigen::MatrixXd& Q,
                                                          double q_terms = 0.0);

/// A must be stable.
[[nodiscard]] std::optional<Eigen::MatrixXd> SolveLyapunov(const Eigen::MatrixXd& A,
                                                           const Eigen::MatrixXd& Q);

}  // namespace levitas::synthesis

#pragma once
// Frequencies at which a quadratic form of a frequency response becomes singular.
//
// Equation   det( [G(jw); I]^H  Pi  [G(jw); I] ) = 0, G(s) = C (sI - A)^-1 B + D, Pi Hermitian:
//            with [Pi11 Pi12; Pi12^H Pi22] split as outputs and inputs of G,
//            Q = C' Pi11 C, S = C' (Pi11 D + Pi12), R = D' Pi11 D + D' Pi12 + Pi12^H D + Pi22,
//            they are the imaginary eigenvalues of [A 0; -Q -A'] - [B; -S] R^-1 [S^H B'].
//            Pi = diag(I, -g^2 I) asks where a singular value of G equals g.
// Source     S. Boyd, V. Balakrishnan, P. Kabamba, Math. Control Signals Systems 2 (1989) 207;
//            K. Zhou, J. C. Doyle, K. Glover, Robust and Optimal Control, 1996, lemma 4.7.
// Use        between two neighbouring crossings the form keeps its sign at every frequency, not
//            only on a grid.
// Failure    nothing when R is singular: a crossing at infinite frequency.
// Thread     any; pure.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "design/synthesis/state_space.hpp"

namespace levitas::synthesis {

/// [rad/s], all >= 0 when `pi` is real and of both signs otherwise, ascending. Eigenvalues within a
/// share of 1e-5 (or 1e-10 of the largest) of the imaginary axis count: no crossing is missed for
/// rounding, a frequency without one may be listed.
[[nodiscard]] std::optional<std::vector<double>> CrossingFrequencies(const StateSpace& system,
                                                                     const Eigen::MatrixXd& pi);
[[nodiscard]] std::optional<std::vector<double>> CrossingFrequencies(const StateSpace& system,
                                                                     const Eigen::MatrixXcd& pi);

}  // namespace levitas::synthesis

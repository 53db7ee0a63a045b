#pragma once
// Continuous linear models as four matrices, and the ways to connect them.
//
// Equation   dx/dt = A x + B u,  y = C x + D u
// Shapes     A n x n, B n x m, C p x n, D p x m; n may be zero (a constant gain).
// Units      [1/s] for A; the inputs' and outputs' units are the caller's. Scale them to be of like
//            size (micrometres and amperes, not metres): the Riccati equations square them.
// Feedback   every loop is closed with a plus sign: u = K y. A minus stands inside a matrix.
// Source     K. Zhou, J. C. Doyle, K. Glover, Robust and Optimal Control, 1996, sections 3.6, 10.1.
// Thread     any; pure. Failure: std::invalid_argument for shapes that do not fit; Problem for an
//            algebraic loop without a solution.

#include <Eigen/Core>
#include <complex>

namespace levitas::synthesis {

struct StateSpace {
  Eigen::MatrixXd A, B, C, D;
  [[nodiscard]] Eigen::Index states() const noexcept { return A.rows(); }
  [[nodiscard]] Eigen::Index inputs() const noexcept { return D.cols(); }
  [[nodiscard]] Eigen::Index outputs() const noexcept { return D.rows(); }
};

/// Throws std::invalid_argument when the shapes do not fit, or a number is not finite.
void CheckShapes(const StateSpace& system);

[[nodiscard]] StateSpace Gain(const Eigen::MatrixXd& gain);

/// second(s) first(s): the outputs of `first` are the inputs of `second`.
[[nodiscard]] StateSpace Series(const StateSpace& first, const StateSpace& second);
/// diag(first, second).
[[nodiscard]] StateSpace Append(const StateSpace& first, const StateSpace& second);
/// diag(one, one, ...).
[[nodiscard]] StateSpace Copies(const StateSpace& one, Eigen::Index count);
/// first(s) + second(s): the same inputs, outputs added.
[[nodiscard]] StateSpace Sum(const StateSpace& first, const StateSpace& second);
/// The system of the transposed transfer matrix.
[[nodiscard]] StateSpace Transposed(const StateSpace& system);

/// K closes the last inputs and outputs of P (w, u -> z, y with u = K y): F_l(P, K).
/// Throws Problem when I - D22 Dk is singular.
[[nodiscard]] StateSpace LowerFeedback(const StateSpace& plant, const StateSpace& controller);

/// G(s) = C (s I - A)^-1 B + D. On a pole it is not finite.
[[nodiscard]] Eigen::MatrixXcd TransferAt(const StateSpace& system, std::complex<double> s);
/// G(jw) = C (jw I - A)^-1 B + D; `rad_per_s` infinite gives D. On a pole it is not finite.
[[nodiscard]] Eigen::MatrixXcd Response(const StateSpace& system, double rad_per_s);

[[nodiscard]] Eigen::VectorXcd Poles(const StateSpace& system);
/// Every pole's real part is negative.
[[nodiscard]] bool IsStable(const StateSpace& system);

/// The same transfer matrix with states scaled by powers of two, so that rows and columns of
/// [A B; C 0] are of like size (E. E. Osborne, J. ACM 7, 1960; no rounding).
[[nodiscard]] StateSpace Balanced(const StateSpace& system);

}  // namespace levitas::synthesis

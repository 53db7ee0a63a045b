#pragma once
// Controllers in discrete time, and delays in continuous time.
//
// Tustin     s = 2/T (z - 1)/(z + 1): A_d = (I - A T/2)^-1 (I + A T/2); the response at w is the
//            continuous one at (2/T) tan(w T/2), stability is kept.
// Hold       zero-order hold of the input: [A_d B_d; 0 I] = exp([A B; 0 0] T); adds half a period
//            of delay, which the plant's delay must hold when the controller is designed.
// Pade       exp(-s T) by the (n, n) Pade approximant, all-pass; its phase is off by at most
//            (w T)^(2n+1) (n!)^2/((2n)! (2n+1)!), two degrees at w T = 2 for n = 2.
// Delay      of the loop (computation, converters) belongs to the plant of the synthesis, through
//            Pade and through the plant's own hold: the controller itself adds none with Tustin.
// Modal      x[n+1] = blocks [re im; -im re] x[n] + ...: each block one real pole or one pair.
// Source     G. F. Franklin, J. D. Powell, M. L. Workman, Digital Control of Dynamic Systems, 3rd
//            ed., chapters 4 and 6.
// Failure    Problem: a pole of the controller at 2/T (Tustin), poles that repeat (modal form).
// Thread     any; pure.

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "design/synthesis/state_space.hpp"

namespace levitas::synthesis {

/// x[n+1] = A x[n] + B u[n], y[n] = C x[n] + D u[n].
struct SampledSystem {
  StateSpace matrices;
  double period_s{};
};

[[nodiscard]] SampledSystem Tustin(const StateSpace& system, double period_s);
[[nodiscard]] SampledSystem ZeroOrderHold(const StateSpace& system, double period_s);

/// Inverse of Tustin: the continuous system of a sampled one, exact at the warped frequencies. A
/// controller made for it by an H-infinity synthesis and brought back by Tustin closes the sampled
/// loop with the same norm: the delay and the hold are in the design without approximation. Throws
/// Problem when the sampled system has a pole at z = -1.
[[nodiscard]] StateSpace InverseTustin(const SampledSystem& sampled);

/// At z = exp(jw T).
[[nodiscard]] Eigen::MatrixXcd Response(const SampledSystem& system, double rad_per_s);

/// Largest difference of the responses up to a frequency, as a share of the largest gain there:
/// what sampling takes from the design.
[[nodiscard]] double SamplingError(const StateSpace& system, const SampledSystem& sampled,
                                   double last_rad_per_s);

/// exp(-s delay) on each of `channels`; order 1 to 4.
[[nodiscard]] StateSpace PadeDelay(double delay_s, int order, Eigen::Index channels);

struct ModalPart {
  std::complex<double> pole;  ///< imaginary part >= 0; 0: one state
  Eigen::MatrixXd B;          ///< 1 x m or 2 x m
  Eigen::MatrixXd C;          ///< p x 1 or p x 2
};

struct ModalSystem {
  std::vector<ModalPart> parts;
  Eigen::MatrixXd D;
};

/// Continuous or sampled alike; the result is checked against the given matrices.
[[nodiscard]] ModalSystem ModalForm(const StateSpace& system);

}  // namespace levitas::synthesis

#pragma once
// Frequency response of a modal rig from command to reading, and its derivatives by every unknown.
//
// Equation  D(s) q = Phi_a diag(ki ha) u,  y = diag(g hs) Phi_s^T q, both planes x, y:
//           D = [Dx, s W G; -s W G, Dy],  Dp = s^2 + 2 z w s + w^2 - sum_b ks_bp a_b a_b^T;
//           ha: amplifier 1/(1 + jf/fa), delay and zero-order hold; hs: sensor 1/(1 + jf/fs).
//           P also has the compliance of the modes beyond the fitted ones, ki ha / (w^2 + s^2);
//           what ks makes of it is left out (1e-3 of a force).
//           dP = Z^T (dPhi_a - dD X) + dPhi_s^T X with X = D^-1 Phi_a, Z = D^-T Phi_s.
// Units     m/A; derivatives by the entries of the vector (modal_parameters.hpp).
// Magnets   ki and ks are those of a small signal. In an experiment j of its own amplitude they are
//           those times WorkingGains (working_gains.hpp): G has a column per experiment, G_j = P_j
//           S_j, and the currents S that were recorded are its inputs.
// Sampling  the hold's images around 10 kHz are left out: below 1e-3 of the mass line in the band
//           of a position loop.
// Thread    any; no shared state.

#include <Eigen/Core>

#include "identification/modal/modal_parameters.hpp"

namespace levitas::identification {

/// Row (output + axes * input), column = unknown.
using ResponseDerivative = Eigen::MatrixXcd;

/// P at one frequency. With `derivative` it is filled too, for all unknowns of the layout.
[[nodiscard]] Eigen::MatrixXcd ModalResponse(const ModalFrame& frame, const Physical& rig,
                                             double frequency_hz, double speed_rad_per_s,
                                             ResponseDerivative* derivative = nullptr);

/// Factors of ki and ks in each experiment: axes x experiments.
struct WorkingGains {
  Eigen::MatrixXd ki, ks;
};

/// G at one frequency; `derivative` as above, rows by output and experiment.
[[nodiscard]] Eigen::MatrixXcd ExperimentResponse(const ModalFrame& frame, const Physical& rig,
                                                  double frequency_hz, double speed_rad_per_s,
                                                  const WorkingGains& gains,
                                                  const Eigen::MatrixXcd& sensitivity,
                                                  ResponseDerivative* derivative = nullptr);

}  // namespace levitas::identification

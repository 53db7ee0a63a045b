#pragma once
// Weights of the H-infinity synthesis of a rig: the numbers that a designer, or a search, moves.
//
// Problem    w = (modes' perturbations, force at the disc, disturbance at the control current,
//            sensor noise), z = (modes, control current, measured position), each divided by what
//            is expected or allowed. Signals after A. Sahinkaya & J. T. Sawicki; the force at the
//            disc is ours: without it a controller hides the rotor's own modes from the coils
//            instead of damping them, and the unbalance, which pushes at the disc, finds them.
// Wd         disturbance_a up to disturbance_hz, then first order down to the share
//            disturbance_floor of it; the same for the force at the disc, whose size is disc_ratio
//            times the rig's own unbalance force at top speed (7.1 N, flexible rotor).
// Wu         1/control_a up to control_hz, rising above in second order to a hundred times that.
// Wp         1/position_rest_m at rest, 1/position_m from position_hz on, first order. z is the
//            measured position: of the true one, noise and stiffness at rest contradict each other
//            (T(0) = 1 hands the noise on: gamma >= noise_m/position_rest_m).
//            The source reaches 36 um at 0.1 Hz, which lets a rotor creep back to its place for a
//            minute; some hertz bring it there within a second. The analysis keeps 0.1 Hz.
// Integrator none: a pole at z = 1 is not stabilisable in the weighted plant. The law's slowest
//            pole is that of Wp, position_hz position_rest_m/position_m, so its gain at rest is
//            finite and the rotor sags by about what position_rest_m allows.
// Modes      each flexible mode below model_hz may move by mode_hz times its share, as a complex
//            perturbation. In the synthesis only, where it stands for frequency, damping and the
//            gyroscopic splitting; the analysis has real parameters (design/uncertainty).
// Speed      speed_ratio > 0: besides, perturbations of the size speed_ratio times the top speed on
//            the gyroscopic moments, W G = (L d)(W L'), |d| <= 1, as many as G = L L' has columns:
//            the splitting of all modes over speed by what causes it, W known from the rig file.
//            Complex, like the modes'; speed_unit scales these channels against the others.
// Defaults   found by design/search for the rig flexible_rotor (2450 syntheses from neutral
//            weights; they look nothing like the limits that the analysis judges by, and need not).
// Lists      entry by entry for bearings or modes; what is beyond the list counts as 1.
// Units      SI, in the names. Thread: plain data.

#include <cstddef>
#include <vector>

namespace levitas::hinf {

struct HinfWeights {
  double disturbance_a{0.357};
  double disturbance_hz{111.0};
  double disturbance_floor{0.532};  ///< [1]
  double disc_ratio{0.329};         ///< [1]
  double disc_hz{52.4};
  double noise_m{0.533e-6};
  double control_a{1.451};
  double control_hz{1607.0};
  double position_rest_m{0.6e-6};
  double position_m{21.3e-6};
  double position_hz{2.2};
  double mode_hz{25.0};
  double speed_ratio{0.0};  ///< [1] of the top speed; 0: the modes' perturbations cover it
  double speed_unit{1.0};   ///< [1]
  double model_hz{1200.0};  ///< modes above are left out of the design's model
  std::vector<double> bearing_disturbance{1.0, 0.597};              ///< [1] share of disturbance_a
  std::vector<double> bearing_position{1.0, 0.808};                 ///< [1] share of position_m
  std::vector<double> mode_share{0.473, 0.521, 0.695, 3.69, 3.94};  ///< [1] share of mode_hz
};

[[nodiscard]] inline double ShareOf(const std::vector<double>& shares, std::size_t index) {
  return index < shares.size() ? shares[index] : 1.0;
}

/// Throws BadInput naming a weight that is not above zero, or two that contradict each other.
void CheckWeights(const HinfWeights& weights);

}  // namespace levitas::hinf

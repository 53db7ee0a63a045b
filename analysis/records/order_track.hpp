#pragma once
// What of a recorded run turns with the rotor, with its phase: complex amplitudes of positions and
// commanded currents, window by window over speed.
//
// Equation  s(n) = m + Re[S e^{j theta}] + Re[S2 e^{2 j theta}], least squares over a window of
//           whole turns (turn_windows.hpp) weighted by Hann's w(n), so that what moves beside the
//           rotation and where the window begins and ends weigh little; theta is the recorded
//           angle, which falls when the rotor turns backwards.
// Noise     white noise of deviation d leaves a deviation of d sqrt(2/samples) in the real and in
//           the imaginary part of S, samples = (sum w)^2 / sum w^2.
// Rows      levitated, positions within the sensors' range, commands not beyond the current limit.
//           A test signal may be on: of the currents all is known.
// Frame     bearing frame; units SI; a negative speed is rotation from y to x.
// Thread    any; offline. Failure: none; without rotation there are no windows.
// Not done  other orders than the first; geared shafts.

#include <Eigen/Core>
#include <vector>

#include "session/exchange/recording.hpp"

namespace levitas::analysis {

struct OrderTrackRule {
  double least_turns{6.0};
  double least_s{0.1};
  double standstill_rad_per_s{20.0};
};

struct TrackedWindow {
  double time_s{};           ///< of its middle, from the record's first row
  double speed_rad_per_s{};  ///< mean, with its sign
  double acceleration_rad_per_s2{};
  double samples{};             ///< that count; see Noise
  Eigen::VectorXcd position_m;  ///< per axis
  Eigen::VectorXcd current_a;
  Eigen::VectorXd mean_position_m;
  Eigen::VectorXd mean_current_a;
};

/// In the order of the record.
[[nodiscard]] std::vector<TrackedWindow> TrackOrder(const session::Recording& recording,
                                                    const OrderTrackRule& rule);

}  // namespace levitas::analysis

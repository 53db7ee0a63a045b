#pragma once
// The part of the vibration that turns with the rotor, over a run-up or run-down.
//
//   r_1 = 1/Theta integral (x + j y) exp(-j theta) dtheta      over Theta, whole turns
//
// |r_1| is the radius of the forward 1X circle, arg r_1 the angle by which its high spot leads the
// rotor's mark; both follow the rotor's own angle, so that a changing speed smears nothing.
//
// Gears    theta is the angle of the bearing's own shaft, ratio x that of the first: 1X of a driven
//          shaft turns with it, backwards through one pair. The probe of the first shaft starts
//          anew each turn, so whole turns are counted from the start of the recording: there all
//          marks are taken to stand at 0 with the first one's.
// Window   at least kTurns whole turns of the slowest shaft and kLeastS seconds, levitated, without
//          a gap; of it each bearing uses whole turns of its own shaft. Windows overlap by half.
// Units    SI. Thread any; offline. Failure: none; without a turning rotor there are no points.

#include <complex>
#include <vector>

#include "report/session/recording.hpp"

namespace levitas::report {

enum class Ramp : std::uint8_t { kSteady, kUp, kDown };

struct SynchronousPoint {
  std::size_t index{};  ///< of the middle of the window
  double speed_rad_per_s{};
  Ramp ramp{};
  std::vector<std::complex<double>> forward_m;  ///< per bearing, with its own shaft
};

inline constexpr double kTurns = 4.0;
inline constexpr double kLeastS = 0.1;

[[nodiscard]] std::vector<SynchronousPoint> Synchronous(const Recording& recording);

}  // namespace levitas::report

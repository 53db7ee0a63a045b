#pragma once
// The part of the vibration that turns with the rotor, over a run-up or run-down.
//
//   r_1 = 1/Theta integral (x + j y) exp(-j theta) dtheta      over Theta, whole turns
//
// |r_1| is the radius of the forward 1X circle, arg r_1 the angle by which its high spot leads the
// rotor's mark; both follow the rotor's own angle, so that a changing speed smears nothing.
//
// Window   at least kTurns whole turns and kLeastS seconds, levitated, without a gap; windows
//          overlap by half.
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
  std::vector<std::complex<double>> forward_m;  ///< per bearing
};

inline constexpr double kTurns = 4.0;
inline constexpr double kLeastS = 0.1;

[[nodiscard]] std::vector<SynchronousPoint> Synchronous(const Recording& recording);

}  // namespace levitas::report

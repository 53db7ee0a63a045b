#pragma once
// A recording made by formula: a rotor that speeds up while it whirls in a known circle.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "report/session/recording.hpp"

namespace levitas::report::test {

inline constexpr double kRadiusM = 10e-6;
inline constexpr double kLeadRad = 0.7;    ///< of the high spot before the rotor's mark
inline constexpr double kOffsetM = 20e-6;  ///< of the circle's middle, in x

struct Whirl {
  double seconds{4.0};
  double top_rad_per_s{400.0};  ///< reached at three quarters of the time, then held
  double direction{1.0};        ///< +1 forward, -1 backward whirl
};

inline Recording WhirlingRotor(const Whirl& whirl = {}) {
  Recording r;
  r.header.pace = "lockstep";
  r.header.rig_yaml = "kind: rig\n";
  r.header.controller_yaml = "kind: controller\n";
  r.rig.name = "made_by_formula";
  r.rig.channels = {"de_x", "de_y"};
  r.rig.bearings = {"de"};
  r.rig.period_ns = 100'000;
  r.rig.bias_current_a = 1.0;
  r.rig.max_coil_current_a = 2.0;
  r.rig.clearance_m = 190e-6;
  r.standstill_rad_per_s = 2.0;
  r.position_m.resize(2);
  r.current_a.resize(2);
  r.top_speed_rad_per_s = whirl.top_rad_per_s;
  const auto count = static_cast<std::uint64_t>(whirl.seconds * 1e4);
  const double ramp_s = 0.75 * whirl.seconds;
  double angle_rad = 0.0;
  for (std::uint64_t n = 0; n < count; ++n) {
    const double time_s = 1e-4 * static_cast<double>(n);
    const double speed = whirl.top_rad_per_s * std::min(1.0, time_s / ramp_s);
    const double at = whirl.direction * (angle_rad + kLeadRad);
    r.cycle.push_back(n);
    r.position_m[0].push_back(static_cast<float>(kOffsetM + kRadiusM * std::cos(at)));
    r.position_m[1].push_back(static_cast<float>(kRadiusM * std::sin(at)));
    r.current_a[0].push_back(0.1F);
    r.current_a[1].push_back(-0.1F);
    r.speed_rad_per_s.push_back(static_cast<float>(speed));
    r.angle_rad.push_back(static_cast<float>(std::fmod(angle_rad, 2.0 * std::numbers::pi)));
    r.sample_time_ns.push_back(static_cast<std::int64_t>(n) * r.rig.period_ns);
    r.levitated.push_back(true);
    angle_rad += speed * 1e-4;
  }
  r.records = count;
  return r;
}

}  // namespace levitas::report::test

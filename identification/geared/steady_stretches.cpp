#include "identification/geared/steady_stretches.hpp"

#include <algorithm>
#include <cmath>

#include "common/two_pi.hpp"
#include "plant_sim/gear/repeat.hpp"

namespace levitas::identification {
namespace {

constexpr double kSameSpeed = 0.003;
constexpr double kTransientS = 0.3;
constexpr double kLeastS = kShortestStretchS - kTransientS;
constexpr double kSlowestRadPerS = 10.0;

}  // namespace

std::vector<double> UnwrappedAngle(const session::Recording& record) {
  std::vector<double> angle(record.rows());
  for (std::size_t n = 0; n < record.rows(); ++n) {
    angle[n] = record.angle_rad[n];
    if (n == 0) continue;
    const auto cycles = static_cast<double>(record.cycle[n] - record.cycle[n - 1]);
    const double expected = angle[n - 1] + record.speed_rad_per_s[n] * cycles * record.period_s();
    angle[n] += kTwoPi * std::round((expected - angle[n]) / kTwoPi);
  }
  return angle;
}

std::vector<SteadyStretch> SteadyStretches(const session::Recording& record,
                                           const std::vector<double>& angle,
                                           const gear::GearPair& pair) {
  const double turns_per_repeat = gear::TurnsPerRepeat(pair);
  std::vector<SteadyStretch> stretches;
  const auto transient = static_cast<std::size_t>(kTransientS / record.period_s());
  const auto least = static_cast<std::size_t>(kLeastS / record.period_s());
  for (std::size_t begin = 0; begin < record.rows();) {
    const double speed = record.speed_rad_per_s[begin];
    std::size_t end = begin;
    while (end < record.rows() && record.levitated[end] != 0 &&
           std::abs(record.speed_rad_per_s[end] - speed) <= kSameSpeed * std::abs(speed)) {
      ++end;
    }
    if (speed > kSlowestRadPerS && end - begin >= least + transient) {
      SteadyStretch stretch{begin + transient, end, 0.0};
      const double repeat = kTwoPi * turns_per_repeat;
      const double whole = std::floor((angle[end - 1] - angle[stretch.begin]) / repeat) * repeat;
      while (angle[stretch.end - 1] - angle[stretch.begin] >= whole) --stretch.end;
      stretch.speed_rad_per_s =
          (angle[stretch.end - 1] - angle[stretch.begin]) /
          (static_cast<double>(stretch.end - 1 - stretch.begin) * record.period_s());
      stretches.push_back(stretch);
    }
    begin = std::max(end, begin + 1);
  }
  return stretches;
}

}  // namespace levitas::identification

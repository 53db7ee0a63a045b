#include "report/session/run_up.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/turn_windows.hpp"

namespace levitas::report {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
/// Slower changes of speed are taken for steady.
constexpr double kRampRadPerS2 = 0.5;

using analysis::AngleStep;
using Window = analysis::TurnWindow;

/// Angle of the first shaft for one turn of the slowest one.
double TurnOfTheSlowest(const Recording& r) {
  double slowest = 1.0;
  for (const double ratio : r.shaft_ratio) slowest = std::min(slowest, std::abs(ratio));
  return kTurn / slowest;
}

/// Angle of the first shaft with whole turns counted, over a gap by its speed. Empty when nothing
/// is geared, where whole turns do not matter.
std::vector<double> CountedAngle(const Recording& r) {
  if (r.shaft_ratio.empty() || r.size() == 0) return {};
  std::vector<double> counted{static_cast<double>(r.angle_rad[0])};
  counted.reserve(r.size());
  for (std::size_t i = 1; i < r.size(); ++i) {
    const double periods = static_cast<double>(r.cycle[i] - r.cycle[i - 1]);
    const double expected_rad =
        static_cast<double>(r.speed_rad_per_s[i - 1]) * periods * r.rig.period_s();
    const double step_rad = AngleStep(r, i);
    counted.push_back(counted.back() + step_rad +
                      kTurn * std::round((expected_rad - step_rad) / kTurn));
  }
  return counted;
}

/// As much of a window as is whole turns of a shaft.
Window WholeTurns(const Recording& r, double ratio, const Window& window) {
  Window whole = window;
  double turned_rad = 0.0;
  double wanted_rad = kTurn;
  for (std::size_t i = window.first + 1; i <= window.last + 1 && i < r.size(); ++i) {
    turned_rad += ratio * AngleStep(r, i);
    if (!(std::abs(turned_rad) >= wanted_rad)) continue;
    whole.last = i - 1;
    wanted_rad += kTurn;
  }
  return whole;
}

/// Over the angle, not over time: a rotor that speeds up spends more samples at its slower angles.
std::complex<double> Forward(const Recording& r, const std::vector<double>& counted_rad,
                             std::size_t bearing, const Window& all) {
  const double ratio = r.RatioOf(bearing);
  const Window window = counted_rad.empty() ? all : WholeTurns(r, ratio, all);
  const auto angle_rad = [&](std::size_t i) {
    return counted_rad.empty() ? static_cast<double>(r.angle_rad[i]) : ratio * counted_rad[i];
  };
  const auto seen = [&](std::size_t i) {  // from the turning rotor
    return std::complex<double>(static_cast<double>(r.position_m[2 * bearing][i]),
                                static_cast<double>(r.position_m[2 * bearing + 1][i])) *
           std::polar(1.0, -angle_rad(i));
  };
  std::complex<double> sum{};
  double turned_rad = 0.0;
  for (std::size_t i = window.first + 1; i <= window.last; ++i) {
    const double step_rad = AngleStep(r, i);
    sum += 0.5 * (seen(i - 1) + seen(i)) * step_rad;
    turned_rad += step_rad;
  }
  return sum / turned_rad;
}

Ramp RampOf(const Recording& r, const Window& window) {
  const double seconds = static_cast<double>(window.last - window.first) * r.rig.period_s();
  const double gained = std::abs(static_cast<double>(r.speed_rad_per_s[window.last])) -
                        std::abs(static_cast<double>(r.speed_rad_per_s[window.first]));
  if (gained > kRampRadPerS2 * seconds) return Ramp::kUp;
  return gained < -kRampRadPerS2 * seconds ? Ramp::kDown : Ramp::kSteady;
}

}  // namespace

std::vector<SynchronousPoint> Synchronous(const Recording& recording) {
  std::vector<SynchronousPoint> points;
  const std::vector<double> counted_rad = CountedAngle(recording);
  analysis::TurnRule rule;
  rule.standstill_rad_per_s = recording.standstill_rad_per_s;
  rule.turn_rad = TurnOfTheSlowest(recording);
  rule.least_turns = kTurns;
  rule.least_s = kLeastS;
  rule.period_s = recording.rig.period_s();
  for (const Window& window : analysis::TurnWindows(recording, rule)) {
    SynchronousPoint point;
    point.index = window.first + (window.last - window.first) / 2;
    point.speed_rad_per_s = std::abs(static_cast<double>(recording.speed_rad_per_s[point.index]));
    point.ramp = RampOf(recording, window);
    for (std::size_t b = 0; b < recording.rig.bearings.size(); ++b) {
      point.forward_m.push_back(Forward(recording, counted_rad, b, window));
    }
    points.push_back(std::move(point));
  }
  return points;
}

}  // namespace levitas::report

#include "report/session/run_up.hpp"

#include <cmath>
#include <numbers>
#include <optional>

namespace levitas::report {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
/// Slower changes of speed are taken for steady.
constexpr double kRampRadPerS2 = 0.5;

struct Window {
  std::size_t first{}, last{};  ///< both included
};

bool Turns(const Recording& r, std::size_t i) {
  return r.levitated[i] &&
         std::abs(static_cast<double>(r.speed_rad_per_s[i])) > r.standstill_rad_per_s;
}

/// The angle may wrap between two samples.
double AngleStep(const Recording& r, std::size_t i) {
  return std::remainder(
      static_cast<double>(r.angle_rad[i]) - static_cast<double>(r.angle_rad[i - 1]), kTurn);
}

/// From `first` on as many whole turns as needed; nothing when the rotor stops or a cycle is gone.
std::optional<Window> WindowFrom(const Recording& r, std::size_t first) {
  double turned_rad = 0.0;
  double wanted_rad = kTurns * kTurn;
  for (std::size_t i = first + 1; i < r.size(); ++i) {
    if (!Turns(r, i) || r.cycle[i] != r.cycle[i - 1] + 1) return std::nullopt;
    turned_rad += AngleStep(r, i);
    if (!(std::abs(turned_rad) >= wanted_rad)) continue;
    if (static_cast<double>(i - first) * r.rig.period_s() >= kLeastS) return Window{first, i - 1};
    wanted_rad += kTurn;
  }
  return std::nullopt;
}

/// Over the angle, not over time: a rotor that speeds up spends more samples at its slower angles.
std::complex<double> Forward(const Recording& r, std::size_t bearing, const Window& window) {
  const auto seen = [&](std::size_t i) {  // from the turning rotor
    return std::complex<double>(static_cast<double>(r.position_m[2 * bearing][i]),
                                static_cast<double>(r.position_m[2 * bearing + 1][i])) *
           std::polar(1.0, -static_cast<double>(r.angle_rad[i]));
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
  std::size_t first = 0;
  while (first + 1 < recording.size()) {
    if (!Turns(recording, first)) {
      ++first;
      continue;
    }
    const auto window = WindowFrom(recording, first);
    if (!window) {
      // Where it ended the next one may begin: nothing shorter fits before that.
      do {
        ++first;
      } while (first < recording.size() && Turns(recording, first) &&
               recording.cycle[first] == recording.cycle[first - 1] + 1);
      continue;
    }
    SynchronousPoint point;
    point.index = window->first + (window->last - window->first) / 2;
    point.speed_rad_per_s = std::abs(static_cast<double>(recording.speed_rad_per_s[point.index]));
    point.ramp = RampOf(recording, *window);
    for (std::size_t b = 0; b < recording.rig.bearings.size(); ++b) {
      point.forward_m.push_back(Forward(recording, b, *window));
    }
    points.push_back(std::move(point));
    first = points.back().index;
  }
  return points;
}

}  // namespace levitas::report

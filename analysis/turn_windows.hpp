#pragma once
// Windows of whole turns of a rotor in a recorded run, for what is taken per turn.
//
// Window   at least `least_turns` turns of `turn_rad` and `least_s` seconds, of rows that are held
//          and turn faster than `standstill_rad_per_s`, without a missing cycle. Windows overlap by
//          half; rows that fit in none are left out.
// Record   anything with columns `cycle`, `levitated`, `speed_rad_per_s` and `angle_rad`; the angle
//          may wrap.
// Thread   any; offline. Failure: none; without a turning rotor there are no windows.

#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <vector>

namespace levitas::analysis {

struct TurnRule {
  double standstill_rad_per_s{};
  double turn_rad{2.0 * std::numbers::pi};  ///< of the first shaft, for one turn that counts
  double least_turns{4.0};
  double least_s{0.1};
  double period_s{};
};

struct TurnWindow {
  std::size_t first{}, last{};  ///< both included
};

template <class Record>
[[nodiscard]] bool TurnsAt(const Record& r, const TurnRule& rule, std::size_t i) {
  return r.levitated[i] &&
         std::abs(static_cast<double>(r.speed_rad_per_s[i])) > rule.standstill_rad_per_s;
}

/// From the row before to row `i`; the angle may wrap between two samples.
template <class Record>
[[nodiscard]] double AngleStep(const Record& r, std::size_t i) {
  return std::remainder(
      static_cast<double>(r.angle_rad[i]) - static_cast<double>(r.angle_rad[i - 1]),
      2.0 * std::numbers::pi);
}

/// From `first` on as many whole turns as needed; nothing when the rotor stops or a cycle is gone.
template <class Record>
[[nodiscard]] std::optional<TurnWindow> WindowFrom(const Record& r, const TurnRule& rule,
                                                   std::size_t first) {
  double turned_rad = 0.0;
  double wanted_rad = rule.least_turns * rule.turn_rad;
  for (std::size_t i = first + 1; i < r.cycle.size(); ++i) {
    if (!TurnsAt(r, rule, i) || r.cycle[i] != r.cycle[i - 1] + 1) return std::nullopt;
    turned_rad += AngleStep(r, i);
    if (!(std::abs(turned_rad) >= wanted_rad)) continue;
    if (static_cast<double>(i - first) * rule.period_s >= rule.least_s) {
      return TurnWindow{first, i - 1};
    }
    wanted_rad += rule.turn_rad;
  }
  return std::nullopt;
}

template <class Record>
[[nodiscard]] std::vector<TurnWindow> TurnWindows(const Record& r, const TurnRule& rule) {
  std::vector<TurnWindow> windows;
  std::size_t first = 0;
  while (first + 1 < r.cycle.size()) {
    if (!TurnsAt(r, rule, first)) {
      ++first;
      continue;
    }
    const auto window = WindowFrom(r, rule, first);
    if (window) {
      windows.push_back(*window);
      first = window->first + (window->last - window->first) / 2;
      continue;
    }
    // Where it ended the next one may begin: nothing shorter fits before that.
    do {
      ++first;
    } while (first < r.cycle.size() && TurnsAt(r, rule, first) &&
             r.cycle[first] == r.cycle[first - 1] + 1);
  }
  return windows;
}

}  // namespace levitas::analysis

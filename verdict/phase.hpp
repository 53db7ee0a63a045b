#pragma once
// Which cycles are judged, and against which objective.
//
// Levitated  modes levitating, spinning and coast_down. All others (off, self-test, lift, landing,
//            tripped) move the rotor on purpose or not at all, and are judged by nothing.
// Settling   the first `settle_s` after the levitated modes are entered is left out: the lift ends
//            with the reference at the centre, the integrator still unloads the touchdown bearing.
//            Changes among the levitated modes exclude nothing.
// Standing   levitated and |speed| at or below the controller's standstill speed; above: spinning.
// Units      rad/s, cycles.
// Thread     one; no allocation.

#include <cmath>
#include <cstdint>

#include "common/enums.hpp"
#include "common/levitated_modes.hpp"

namespace levitas::verdict {

enum class Phase : std::uint8_t { kNotJudged, kStanding, kSpinning };

class PhaseSplitter {
 public:
  PhaseSplitter(double standstill_rad_per_s, std::uint64_t settle_cycles) noexcept
      : standstill_rad_per_s_(standstill_rad_per_s), settle_cycles_(settle_cycles) {}

  /// Phase of one cycle; call once per cycle, in order. `cycle` may have gaps.
  [[nodiscard]] Phase Next(std::uint64_t cycle, Mode mode, double speed_rad_per_s) noexcept {
    if (!IsLevitated(mode)) {
      levitated_ = false;
      return Phase::kNotJudged;
    }
    if (!levitated_) {
      levitated_ = true;
      levitated_since_ = cycle;
    }
    if (cycle - levitated_since_ < settle_cycles_) return Phase::kNotJudged;
    return std::abs(speed_rad_per_s) <= standstill_rad_per_s_ ? Phase::kStanding : Phase::kSpinning;
  }

 private:
  double standstill_rad_per_s_;
  std::uint64_t settle_cycles_;
  std::uint64_t levitated_since_{0};
  bool levitated_{false};
};

}  // namespace levitas::verdict

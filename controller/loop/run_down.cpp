#include "controller/loop/run_down.hpp"

#include <algorithm>
#include <cmath>

namespace levitas::loop {

namespace {
constexpr double kMostCycles = 1e15;
}  // namespace

RunDown::RunDown(const RunDownLimits& limits) noexcept : limits_(limits) {
  const double rate = limits_.deceleration_rad_per_s2;
  const double slowest_s = rate > 0.0 ? 2.0 * limits_.standstill_rad_per_s / rate : 0.0;
  fall_.cycles = Cycles(0.5 * kMarginS + slowest_s);
  fall_.fall_rad_per_s = limits_.standstill_rad_per_s;
  brake_.cycles = Cycles(std::max(kBrakeS, slowest_s));
  brake_.fall_rad_per_s =
      kBrakeShare * rate * static_cast<double>(brake_.cycles) * limits_.period_s;
}

std::uint64_t RunDown::Cycles(double seconds) const noexcept {
  return static_cast<std::uint64_t>(
      std::llround(std::clamp(seconds / limits_.period_s, 1.0, kMostCycles)));
}

void RunDown::Start(Windows& windows, std::uint64_t cycle) const noexcept {
  windows.since = cycle;
  windows.from_rad_per_s = speed_rad_per_s_;
}

// Written so that a NaN is no fall; the next edge is then compared with the one before it.
void RunDown::Step(Windows& windows, std::uint64_t cycle) const noexcept {
  if (cycle - windows.since < windows.cycles) return;
  const bool fell = windows.from_rad_per_s - speed_rad_per_s_ >= windows.fall_rad_per_s;
  windows.missed = fell || standing_ ? 0 : std::min(windows.missed + 1, kMissed);
  windows.since = cycle;
  if (std::isfinite(speed_rad_per_s_)) windows.from_rad_per_s = speed_rad_per_s_;
}

void RunDown::Look(std::uint64_t cycle, double speed_rad_per_s, bool standing) noexcept {
  speed_rad_per_s_ = std::abs(speed_rad_per_s);
  standing_ = standing;
  Step(fall_, cycle);
  Step(brake_, cycle);
}

void RunDown::Begin(std::uint64_t cycle) noexcept {
  const double from_rad_per_s = std::isfinite(speed_rad_per_s_) ? speed_rad_per_s_ : 0.0;
  const double rate = limits_.deceleration_rad_per_s2;
  const double run_down_s = rate > 0.0 ? from_rad_per_s / rate : 0.0;
  begin_ = cycle;
  limit_cycles_ = Cycles(run_down_s + limits_.landing_ramp_s + kMarginS);
  fall_.missed = brake_.missed = 0;
  Start(fall_, cycle);
  Start(brake_, cycle);
}

// A rotor that stands and does not come down has no fall to wait for.
bool RunDown::Overdue(std::uint64_t cycle) const noexcept {
  return cycle - begin_ > limit_cycles_ && (standing_ || fall_.missed >= kMissed);
}

}  // namespace levitas::loop

#include "controller/scenario/excitation_guard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace levitas::scenario {
namespace {

bool AnyOf(const AxisArray& signal) noexcept {
  return std::any_of(signal.begin(), signal.end(), [](double value) { return value != 0.0; });
}

double Magnitude(const AxisArray& signal, std::size_t x) noexcept {
  return std::sqrt(signal[x] * signal[x] + signal[x + 1] * signal[x + 1]);
}

std::string BearingName(const GuardNotice& notice, const RigNumbers& rig) {
  return notice.bearing < rig.bearings.size() ? rig.bearings[notice.bearing]
                                              : std::to_string(notice.bearing);
}

}  // namespace

GuardLimits LimitsOf(const RigNumbers& rig, double law_limit_a) noexcept {
  GuardLimits limits;
  limits.axes = rig.axes();
  limits.period_s = rig.period_s();
  limits.current_a = std::min(rig.bias_current_a, rig.max_coil_current_a - rig.bias_current_a);
  if (law_limit_a > 0.0) limits.current_a = std::min(limits.current_a, law_limit_a);
  for (std::size_t b = 0; 2 * b < limits.axes; ++b) limits.clearance_m[b] = rig.ClearanceOf(b);
  return limits;
}

std::string Text(const GuardNotice& notice, const RigNumbers& rig) {
  const std::string bearing = BearingName(notice, rig);
  switch (notice.why) {
    case Reduced::kCurrentSum:
      return fmt::format(
          "test signals reduced: together they ask for {:.3g} A in bearing {}, {:.3g} A is the "
          "share of what the coils leave; the law needs the rest",
          notice.asked, bearing, notice.allowed);
    case Reduced::kShiftSum:
      return fmt::format(
          "test signals reduced: together they shift the position of bearing {} by {:.4g} um, "
          "{:.4g} um is the share of the clearance",
          bearing, notice.asked * 1e6, notice.allowed * 1e6);
    case Reduced::kRadius:
      return fmt::format(
          "test signals cut off: the rotor is or will be within milliseconds at {:.0f} % of the "
          "clearance "
          "of bearing {}, {:.0f} % are allowed; they come back within seconds",
          100.0 * notice.asked, bearing, 100.0 * notice.allowed);
    case Reduced::kOrbitLimit:
      break;
  }
  return "test signals reduced: the orbit is beyond the orbit_limit_um of their step";
}

ExcitationGuard::ExcitationGuard(const GuardLimits& limits)
    : limits_(limits),
      smooth_(-std::expm1(-limits.period_s / kVelocityS)),
      recover_(-std::expm1(-limits.period_s / kRecoveryS)),
      quiet_cycles_(limits.period_s > 0.0
                        ? static_cast<std::uint64_t>(std::llround(kQuietTimeS / limits.period_s))
                        : 0) {}

void ExcitationGuard::Note(Reduced why, const GuardNotice& notice) noexcept {
  const auto at = static_cast<std::size_t>(why);
  ++counts_.cycles[at];
  const bool begins = noted_cycle_[at] == 0 || cycle_ + 1 - noted_cycle_[at] > quiet_cycles_;
  noted_cycle_[at] = cycle_ + 1;
  if (begins) notices_.Post({why, notice.bearing, notice.asked, notice.allowed});
}

void ExcitationGuard::Follow(const AxisArray& position_m) noexcept {
  for (std::size_t i = 0; i < limits_.axes; ++i) {
    const double rate = any_ ? (position_m[i] - last_m_[i]) / limits_.period_s : 0.0;
    velocity_m_per_s_[i] += smooth_ * (rate - velocity_m_per_s_[i]);
    last_m_[i] = position_m[i];
  }
  any_ = true;
}

// The bearing whose rotor is farthest out, now or ahead; a share that is no number is returned.
ExcitationGuard::Farthest ExcitationGuard::Look(const AxisArray& position_m,
                                                double ahead_s) noexcept {
  Follow(position_m);
  Farthest farthest;
  for (std::size_t b = 0; 2 * b < limits_.axes; ++b) {
    double now = 0.0;
    double ahead = 0.0;
    for (std::size_t i = 2 * b; i < std::min(2 * b + 2, limits_.axes); ++i) {
      const double there_m = position_m[i] + ahead_s * velocity_m_per_s_[i];
      now += position_m[i] * position_m[i];
      ahead += there_m * there_m;
    }
    const double share = std::sqrt(std::max(now, ahead)) / limits_.clearance_m[b];
    if (share <= farthest.share) continue;
    farthest = {b, share};
    if (!std::isnan(ahead)) continue;
    velocity_m_per_s_ = {};  // the filter would keep it
    any_ = false;
    return {b, ahead};
  }
  return farthest;
}

void ExcitationGuard::LimitSum(std::size_t bearing, AxisArray& excitation_a,
                               AxisArray& excitation_m) noexcept {
  const std::size_t x = 2 * bearing;
  const double asked_a = Magnitude(excitation_a, x);
  const double asked_m = Magnitude(excitation_m, x);
  const double used = asked_a / (kShare * limits_.current_a) +
                      asked_m / (kShiftShare * limits_.clearance_m[bearing]);
  if (!(used > 1.0)) return;
  for (std::size_t i = x; i < x + 2; ++i) {
    excitation_a[i] /= used;
    excitation_m[i] /= used;
  }
  if (asked_a > 0.0) {
    Note(Reduced::kCurrentSum, {Reduced::kCurrentSum, bearing, asked_a, asked_a / used});
  }
  if (asked_m > 0.0) {
    Note(Reduced::kShiftSum, {Reduced::kShiftSum, bearing, asked_m, asked_m / used});
  }
}

void ExcitationGuard::Limit(const AxisArray& position_m, AxisArray& excitation_a,
                            AxisArray& excitation_m) noexcept {
  if (limits_.axes == 0) return;
  ++cycle_;
  const bool current = AnyOf(excitation_a);
  if (current) current_cycle_ = cycle_;
  const Farthest farthest = Look(position_m, Lately(current_cycle_) ? kAheadS : kShiftAheadS);
  if (!(farthest.share < kCutFraction)) {
    gain_ = 0.0;
  } else if (farthest.share < kQuietFraction && gain_ < 1.0) {
    gain_ = Lately(asked_cycle_) ? gain_ + recover_ * (1.0 - gain_) : 1.0;
    if (gain_ > 0.99) gain_ = 1.0;
  }
  if (!current && !AnyOf(excitation_m)) return;
  asked_cycle_ = cycle_;
  if (farthest.share > counts_.farthest) counts_.farthest = farthest.share;
  for (std::size_t b = 0; 2 * b < limits_.axes; ++b) {
    LimitSum(b, excitation_a, excitation_m);
  }
  if (gain_ == 1.0) return;
  Note(Reduced::kRadius, {Reduced::kRadius, farthest.bearing, farthest.share, kCutFraction});
  for (double& value : excitation_a) value *= gain_;
  for (double& value : excitation_m) value *= gain_;
}

}  // namespace levitas::scenario

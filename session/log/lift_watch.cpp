#include "session/log/lift_watch.hpp"

#include <algorithm>
#include <cmath>

namespace levitas::session {
namespace {

/// Of the bearing that the axis belongs to.
double DistanceOf(const AxisArray& at_m, std::size_t axis) noexcept {
  if (axis >= kMaxAxes) return 0.0;
  const std::size_t x = axis - axis % 2;
  return std::hypot(at_m[x], at_m[x + 1]);
}

}  // namespace

LiftWatch::LiftWatch(double period_s) noexcept : weight_(std::min(1.0, period_s / kLiftMemoryS)) {}

void LiftWatch::Add(const cycle::CycleRecord& record) noexcept {
  if (record.out.mode != Mode::kLift) {
    // The tripping record itself is no longer of the lift; what led to it is kept until the next.
    if (record.out.mode == Mode::kSelfTest || record.out.mode == Mode::kLevitating)
      *this = LiftWatch(weight_ * kLiftMemoryS);
    return;
  }
  if (!record.in.frame_present) return;
  const double weight = filled_ ? weight_ : 1.0;
  if (!filled_) start_m_ = record.in.frame.position_m;
  filled_ = true;
  for (std::size_t i = 0; i < kMaxAxes; ++i) {
    const auto mean = [weight](double& value, double now) {
      if (std::isfinite(now)) value += weight * (now - value);
    };
    mean(place_m_[i], record.in.frame.position_m[i]);
    mean(current_a_[i], record.out.current.control_current_a[i]);
    const double limited = (record.out.saturated_axes >> i & 1U) != 0U ? 1.0 : 0.0;
    mean(limited_share_[i], limited);
    mean(limited_side_[i], std::copysign(limited, record.out.current.control_current_a[i]));
  }
}

LiftReason LiftWatch::ReasonOf(std::size_t axis, double settle_radius_m) const noexcept {
  if (!filled_ || axis >= kMaxAxes) return LiftReason::kUnknown;
  const std::size_t x = axis - axis % 2;
  // Half of the cycles: a current that only touches its limit with the noise is no lack of force.
  const std::size_t most = limited_share_[x] >= limited_share_[x + 1] ? x : x + 1;
  if (limited_share_[most] > 0.5) {
    const bool one_side = std::abs(limited_side_[most]) > 0.5 * limited_share_[most];
    return one_side ? LiftReason::kAtLimit : LiftReason::kLimitToLimit;
  }
  return SagOf(axis) > settle_radius_m ? LiftReason::kSags : LiftReason::kSwings;
}

LiftReason LiftWatch::ReasonOfLimit(std::size_t axis) const noexcept {
  if (!filled_ || axis >= kMaxAxes) return LiftReason::kUnknown;
  const bool one_side = std::abs(limited_side_[axis]) > 0.5 * limited_share_[axis];
  return one_side ? LiftReason::kAtLimit : LiftReason::kLimitToLimit;
}

double LiftWatch::SagOf(std::size_t axis) const noexcept { return DistanceOf(place_m_, axis); }

double LiftWatch::StartOf(std::size_t axis) const noexcept { return DistanceOf(start_m_, axis); }

double LiftWatch::CurrentOf(std::size_t axis) const noexcept {
  return axis < kMaxAxes ? std::abs(current_a_[axis]) : 0.0;
}

}  // namespace levitas::session

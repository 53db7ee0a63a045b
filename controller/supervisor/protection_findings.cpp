// What the counters of the protections amount to: the first armed fault, with its evidence.

#include <cmath>

#include "common/frames.hpp"
#include "controller/supervisor/protections.hpp"
#include "controller/supervisor/radius.hpp"

namespace levitas::supervisor {
namespace {

std::int8_t AxisNumber(std::size_t axis) noexcept { return static_cast<std::int8_t>(axis); }

}  // namespace

Finding Protections::FindSignalFault(const Observation& seen, FaultSet armed) const noexcept {
  Finding found;
  const auto look = [&](Finding candidate) {
    if (found.fault == Fault::kNone && (armed & Bit(candidate.fault)) != 0) found = candidate;
  };
  if (seen.fresh && seen.rig_session != session_) {
    look({Fault::kRigRestarted, -1, static_cast<double>(seen.rig_session),
          static_cast<double>(session_)});
  }
  look(FrameMissing(seen));
  if (seen.fresh) {
    look(NotFinite(seen));
    look(AmplifierFault(seen));
    look(OutOfRange(seen));
    look(Frozen());
  }
  return found;
}

Finding Protections::FrameMissing(const Observation& seen) const noexcept {
  if (frames_missing_ >= config_.frame_missing_cycles) {
    return {Fault::kFrameMissing, -1, static_cast<double>(frames_missing_),
            static_cast<double>(config_.frame_missing_cycles)};
  }
  if (cut_.Full(seen.cycle)) {
    return {Fault::kFrameMissing, -1, static_cast<double>(cut_.limit()),
            static_cast<double>(cut_.limit())};
  }
  return {};
}

Finding Protections::FindMotionFault(const Observation& seen,
                                     const Circumstances& now) const noexcept {
  Finding found;
  const auto look = [&](Finding candidate) {
    if (found.fault == Fault::kNone && (now.armed & Bit(candidate.fault)) != 0) found = candidate;
  };
  const auto count = [&](Fault fault, const EventWindow& events) {
    const auto limit = static_cast<double>(events.limit());
    if (events.Full(seen.cycle)) look({fault, -1, limit, limit});
  };
  // Also in an old frame: lines are read without one, and a stop does not wait for the next.
  if (now.stop_requested || (seen.rig_status & kRigEmergencyStop) != 0) {
    look({Fault::kEmergencyStop, -1, 1.0, 0.0});
  }
  if (seen.fresh && (seen.rig_status & kRigSpeedUnknown) != 0) {
    look({Fault::kSpeedUnknown, -1, 1.0, 0.0});
  }
  // As read, believed or not: a stop that was not needed costs less than a cycle too fast.
  if (seen.fresh && std::isfinite(seen.speed_rad_per_s) &&
      std::abs(seen.speed_rad_per_s) > speed_limit_rad_per_s_) {
    look({Fault::kOverSpeed, -1, std::abs(seen.speed_rad_per_s), speed_limit_rad_per_s_});
  }
  look(now.speed);
  look(Orbit(seen, now.reference_m));
  look(Saturated());
  count(Fault::kDeadlineMissed, deadlines_);
  count(Fault::kFramesLost, lost_);
  count(Fault::kCurrentsLate, late_);
  return found;
}

// The value is given as 0: NaN would not even equal itself when a replay compares the outputs.
Finding Protections::NotFinite(const Observation& seen) const noexcept {
  for (std::size_t i = 0; i < axes_; ++i) {
    if (!std::isfinite(seen.position_m[i])) {
      return {Fault::kSensorNotFinite, AxisNumber(i), 0.0, range_limit_m_[i]};
    }
  }
  return {};
}

Finding Protections::OutOfRange(const Observation& seen) const noexcept {
  for (std::size_t i = 0; i < axes_; ++i) {
    if (out_of_range_[i] >= config_.sensor_range_cycles) {
      return {Fault::kSensorOutOfRange, AxisNumber(i), seen.position_m[i], range_limit_m_[i]};
    }
  }
  return {};
}

// The first reading counts too: n identical readings are n - 1 repetitions.
Finding Protections::Frozen() const noexcept {
  for (std::size_t i = 0; i < axes_; ++i) {
    if (std::uint64_t{unchanged_[i]} + 1 >= config_.sensor_frozen_cycles && unchanged_[i] > 0) {
      return {Fault::kSensorFrozen, AxisNumber(i), static_cast<double>(unchanged_[i]) + 1.0,
              static_cast<double>(config_.sensor_frozen_cycles)};
    }
  }
  return {};
}

Finding Protections::AmplifierFault(const Observation& seen) const noexcept {
  if ((seen.rig_status & kRigAmplifierFault) != 0) return {Fault::kAmplifierFault, -1, 1.0, 0.0};
  if (amplifiers_silent_ >= kAmplifierAnswerCycles) {
    return {Fault::kAmplifierFault, -1, static_cast<double>(amplifiers_silent_),
            static_cast<double>(kAmplifierAnswerCycles)};
  }
  return {};
}

Finding Protections::Orbit(const Observation& seen, const AxisArray& reference_m) const noexcept {
  for (std::size_t b = 0; 2 * b < axes_; ++b) {
    if (orbit_[b].periods < config_.orbit_cycles) continue;
    return OrbitFinding(Deviation(seen.position_m, reference_m), b, orbit_limit_m_[b]);
  }
  return {};
}

Finding Protections::Contact(const Observation& seen) const noexcept {
  for (std::size_t b = 0; 2 * b < axes_; ++b) {
    if (contact_[b].periods < contact_limit_cycles_) continue;
    return OrbitFinding(seen.position_m, b, clearance_m_[b]);
  }
  return {};
}

Finding Protections::OrbitFinding(const AxisArray& from_m, std::size_t bearing,
                                  double limit_m) const noexcept {
  const std::size_t x = 2 * bearing;
  const bool x_is_larger = std::abs(from_m[x]) >= std::abs(from_m[x + 1]);
  return {Fault::kOrbitExceeded, AxisNumber(x_is_larger ? x : x + 1), Radius(from_m, bearing),
          limit_m};
}

Finding Protections::Saturated() const noexcept {
  for (std::size_t i = 0; i < axes_; ++i) {
    if (saturated_[i] >= saturated_limit_cycles_) {
      return {Fault::kCoilSaturated, AxisNumber(i), saturated_[i] * period_s_,
              config_.coil_saturated_s};
    }
  }
  return {};
}

}  // namespace levitas::supervisor

#include "controller/supervisor/protections.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "common/frames.hpp"

namespace levitas::supervisor {
namespace {

constexpr std::uint32_t kMostMisses = 1'000'000;  // each keeps one cycle number
constexpr std::uint32_t kForever = std::numeric_limits<std::uint32_t>::max();

void NeedPositive(double value, const char* name) {
  if (!(value > 0.0) || !std::isfinite(value)) {
    throw std::invalid_argument(std::string("supervisor: ") + name + " = " + std::to_string(value) +
                                ", must be finite and greater than 0");
  }
}

// Counts up without wrapping while `condition` holds, else starts again.
void CountWhile(bool condition, std::uint32_t& counter) noexcept {
  counter = condition ? counter + (counter < kForever ? 1U : 0U) : 0U;
}

// Whole periods that last at least `time_s`; the millionth forgives rounding of the quotient.
std::uint32_t Cycles(double time_s, double period_s) noexcept {
  const double cycles = std::ceil(time_s / period_s - 1e-6);
  return static_cast<std::uint32_t>(std::clamp(cycles, 1.0, static_cast<double>(kForever - 1)));
}

std::int8_t AxisNumber(std::size_t axis) noexcept { return static_cast<std::int8_t>(axis); }

}  // namespace

Protections::Protections(const RigNumbers& rig, const ProtectionConfig& config)
    : axes_(rig.axes()),
      config_(config),
      speed_limit_rad_per_s_(config.over_speed_fraction * rig.max_speed_rad_per_s),
      period_s_(rig.period_s()) {
  for (std::size_t b = 0; 2 * b < axes_; ++b) {
    clearance_m_[b] = rig.ClearanceOf(b);
    orbit_limit_m_[b] = config.orbit_fraction * rig.ClearanceOf(b);
    NeedPositive(orbit_limit_m_[b], "orbit_fraction x clearance_m");
  }
  for (std::size_t i = 0; i < axes_; ++i) {
    range_limit_m_[i] = config.sensor_range_fraction * rig.SensorRangeOf(i / 2);
    NeedPositive(range_limit_m_[i], "sensor_range_fraction x sensor_range_m");
  }
  NeedPositive(speed_limit_rad_per_s_, "over_speed_fraction x max_speed_rad_per_s");
  NeedPositive(period_s_, "period_s");
  NeedPositive(config.orbit_cycles, "orbit_cycles");
  NeedPositive(config.sensor_range_cycles, "sensor_range_cycles");
  NeedPositive(config.sensor_frozen_cycles, "sensor_frozen_cycles");
  NeedPositive(config.frame_missing_cycles, "frame_missing_cycles");
  NeedPositive(config.deadline_missed_cycles, "deadline_missed_cycles");
  NeedPositive(config.deadline_window_cycles, "deadline_window_cycles");
  NeedPositive(config.coil_saturated_s, "coil_saturated_s");
  saturated_limit_cycles_ = Cycles(config.coil_saturated_s, period_s_);
  contact_limit_cycles_ = Cycles(kContactS, period_s_);
  if (config.deadline_missed_cycles > kMostMisses) {
    throw std::invalid_argument(
        "supervisor: deadline_missed_cycles = " + std::to_string(config.deadline_missed_cycles) +
        ", allowed 1 to " + std::to_string(kMostMisses));
  }
  misses_.resize(config.deadline_missed_cycles);
}

Finding Protections::Check(const Observation& seen, FaultSet armed, bool energised,
                           bool stop_requested) noexcept {
  Count(seen, energised);
  const Finding signal = FindSignalFault(seen, armed);
  if (signal.fault != Fault::kNone) return signal;
  return FindMotionFault(seen, armed, stop_requested);
}

void Protections::AcceptSession(std::uint32_t rig_session) noexcept {
  session_ = rig_session;
  session_known_ = true;
}

bool Protections::SignalsGood(const Observation& seen) const noexcept {
  if (!seen.fresh ||
      (seen.rig_status & (kRigEmergencyStop | kRigAmplifierFault | kRigSpeedUnknown)) != 0) {
    return false;
  }
  if (NotFinite(seen).fault != Fault::kNone || Frozen().fault != Fault::kNone) return false;
  for (std::size_t i = 0; i < axes_; ++i) {
    if (std::abs(seen.position_m[i]) >= range_limit_m_[i]) return false;
  }
  return true;
}

void Protections::Count(const Observation& seen, bool energised) noexcept {
  CountWhile(!seen.fresh, frames_missing_);
  for (std::uint32_t i = 0; i < std::min<std::size_t>(seen.missed_deadlines, misses_.size()); ++i) {
    misses_[next_miss_] = seen.cycle;
    next_miss_ = next_miss_ + 1 == misses_.size() ? 0 : next_miss_ + 1;
    miss_count_ = std::min(miss_count_ + 1, misses_.size());
  }
  for (std::size_t i = 0; i < axes_; ++i) {
    CountWhile(energised && (seen.saturated_axes >> i & 1U) != 0, saturated_[i]);
  }
  if (!seen.fresh) return;  // no new evidence about the signals
  CountWhile(energised && (seen.rig_status & kRigAmplifiersOff) != 0, amplifiers_silent_);
  for (std::size_t i = 0; i < axes_; ++i) {
    const double position_m = seen.position_m[i];
    CountWhile(std::abs(position_m) >= range_limit_m_[i], out_of_range_[i]);
    CountWhile(has_position_ && position_m == last_position_m_[i], unchanged_[i]);
    last_position_m_[i] = position_m;
  }
  has_position_ = true;
  for (std::size_t b = 0; 2 * b < axes_; ++b) {
    const double radius_m = Radius(seen, b);
    CountWhile(radius_m > orbit_limit_m_[b], beyond_orbit_[b]);
    std::uint32_t& contact = in_contact_[b];
    if (radius_m >= clearance_m_[b]) {
      contact = std::min(contact + 1, contact_limit_cycles_);
    } else if (contact > 0) {
      --contact;
    }
  }
}

Finding Protections::FindSignalFault(const Observation& seen, FaultSet armed) const noexcept {
  Finding found;
  const auto look = [&](Finding candidate) {
    if (found.fault == Fault::kNone && (armed & Bit(candidate.fault)) != 0) found = candidate;
  };
  if (seen.fresh && seen.rig_session != session_) {
    look({Fault::kRigRestarted, -1, static_cast<double>(seen.rig_session),
          static_cast<double>(session_)});
  }
  if (frames_missing_ >= config_.frame_missing_cycles) {
    look({Fault::kFrameMissing, -1, static_cast<double>(frames_missing_),
          static_cast<double>(config_.frame_missing_cycles)});
  }
  if (seen.fresh) {
    look(NotFinite(seen));
    look(AmplifierFault(seen));
    look(OutOfRange(seen));
    look(Frozen());
  }
  return found;
}

Finding Protections::FindMotionFault(const Observation& seen, FaultSet armed,
                                     bool stop_requested) const noexcept {
  Finding found;
  const auto look = [&](Finding candidate) {
    if (found.fault == Fault::kNone && (armed & Bit(candidate.fault)) != 0) found = candidate;
  };
  // Also in an old frame: lines are read without one, and a stop does not wait for the next.
  if (stop_requested || (seen.rig_status & kRigEmergencyStop) != 0) {
    look({Fault::kEmergencyStop, -1, 1.0, 0.0});
  }
  if (seen.fresh && (seen.rig_status & kRigSpeedUnknown) != 0) {
    look({Fault::kSpeedUnknown, -1, 1.0, 0.0});
  }
  if (seen.fresh && std::abs(seen.speed_rad_per_s) > speed_limit_rad_per_s_) {
    look({Fault::kOverSpeed, -1, std::abs(seen.speed_rad_per_s), speed_limit_rad_per_s_});
  }
  look(Orbit(seen));
  look(Saturated());
  look(DeadlineMissed(seen));
  return found;
}

// The value is given as 0: NaN would not even equal itself when a replay compares the outputs.
Finding Protections::NotFinite(const Observation& seen) const noexcept {
  for (std::size_t i = 0; i < axes_; ++i) {
    if (!std::isfinite(seen.position_m[i])) {
      return {Fault::kSensorNotFinite, AxisNumber(i), 0.0, range_limit_m_[i]};
    }
  }
  if (!std::isfinite(seen.speed_rad_per_s)) {
    return {Fault::kSensorNotFinite, -1, 0.0, speed_limit_rad_per_s_};
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

Finding Protections::Orbit(const Observation& seen) const noexcept {
  for (std::size_t b = 0; 2 * b < axes_; ++b) {
    if (beyond_orbit_[b] >= config_.orbit_cycles) return OrbitFinding(seen, b, orbit_limit_m_[b]);
  }
  return {};
}

Finding Protections::Contact(const Observation& seen) const noexcept {
  for (std::size_t b = 0; 2 * b < axes_; ++b) {
    if (in_contact_[b] >= contact_limit_cycles_) return OrbitFinding(seen, b, clearance_m_[b]);
  }
  return {};
}

Finding Protections::OrbitFinding(const Observation& seen, std::size_t bearing,
                                  double limit_m) const noexcept {
  const std::size_t x = 2 * bearing;
  const bool x_is_larger = std::abs(seen.position_m[x]) >= std::abs(seen.position_m[x + 1]);
  return {Fault::kOrbitExceeded, AxisNumber(x_is_larger ? x : x + 1), Radius(seen, bearing),
          limit_m};
}

Finding Protections::DeadlineMissed(const Observation& seen) const noexcept {
  if (miss_count_ < misses_.size()) return {};
  const std::uint64_t oldest = misses_[next_miss_];
  if (seen.cycle - oldest >= config_.deadline_window_cycles) return {};
  return {Fault::kDeadlineMissed, -1, static_cast<double>(miss_count_),
          static_cast<double>(config_.deadline_missed_cycles)};
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

double Protections::Radius(const Observation& seen, std::size_t bearing) const noexcept {
  const double x_m = seen.position_m[2 * bearing];
  const double y_m = seen.position_m[2 * bearing + 1];
  return std::sqrt(x_m * x_m + y_m * y_m);
}

}  // namespace levitas::supervisor

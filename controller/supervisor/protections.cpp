#include "controller/supervisor/protections.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "common/frames.hpp"
#include "controller/supervisor/radius.hpp"

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

std::size_t Room(std::uint32_t events, const char* name) {
  if (events == 0 || events > kMostMisses) {
    throw std::invalid_argument(std::string("supervisor: ") + name + " = " +
                                std::to_string(events) + ", allowed 1 to " +
                                std::to_string(kMostMisses));
  }
  return events;
}

// A window of four times as many cycles as are a cut in a row; beyond what a file may ask for the
// cut is out of reach.
EventWindow CutWindow(std::uint32_t frame_missing_cycles) {
  const std::uint64_t window = 4 * std::uint64_t{frame_missing_cycles};
  if (window > kMostMisses) return {1, 0};
  const auto limit = static_cast<std::size_t>(
      std::ceil(kCutShare * static_cast<double>(std::max<std::uint64_t>(window, 1))));
  return {limit, window};
}

}  // namespace

Protections::Protections(const RigNumbers& rig, const ProtectionConfig& config)
    : axes_(rig.axes()),
      config_(config),
      speed_limit_rad_per_s_(config.over_speed_fraction * rig.max_speed_rad_per_s),
      period_s_(rig.period_s()),
      deadlines_(Room(config.deadline_missed_cycles, "deadline_missed_cycles"),
                 config.deadline_window_cycles),
      lost_(Room(config.frames_lost_cycles, "frames_lost_cycles"),
            config.frames_lost_window_cycles),
      cut_(CutWindow(config.frame_missing_cycles)),
      late_(Room(config.currents_late_cycles, "currents_late_cycles"),
            config.currents_late_window_cycles) {
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
  NeedPositive(config.frames_lost_window_cycles, "frames_lost_window_cycles");
  NeedPositive(config.currents_late_window_cycles, "currents_late_window_cycles");
  NeedPositive(config.deadline_window_cycles, "deadline_window_cycles");
  NeedPositive(config.coil_saturated_s, "coil_saturated_s");
  saturated_limit_cycles_ = Cycles(config.coil_saturated_s, period_s_);
  contact_limit_cycles_ = Cycles(kContactS, period_s_);
}

Finding Protections::Check(const Observation& seen, const Circumstances& now) noexcept {
  Count(seen, now);
  const Finding signal = FindSignalFault(seen, now.armed);
  if (signal.fault != Fault::kNone) return signal;
  return FindMotionFault(seen, now);
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

void Protections::Count(const Observation& seen, const Circumstances& now) noexcept {
  CountTransport(seen, now.energised);
  for (std::size_t i = 0; i < axes_; ++i) {
    CountWhile(now.energised && (seen.saturated_axes >> i & 1U) != 0, saturated_[i]);
  }
  CountMotion(seen, now);
  if (!seen.fresh) return;  // no new evidence about the signals
  CountWhile(now.energised && (seen.rig_status & kRigAmplifiersOff) != 0, amplifiers_silent_);
  for (std::size_t i = 0; i < axes_; ++i) {
    const double position_m = seen.position_m[i];
    CountWhile(std::abs(position_m) >= range_limit_m_[i], out_of_range_[i]);
    CountWhile(has_position_ && position_m == last_position_m_[i], unchanged_[i]);
    last_position_m_[i] = position_m;
  }
  has_position_ = true;
}

// A rig counts the periods it held; one that only reports each of them has its status bit.
void Protections::CountTransport(const Observation& seen, bool energised) noexcept {
  CountWhile(!seen.fresh, frames_missing_);
  deadlines_.Add(seen.cycle, seen.missed_deadlines);
  if (!seen.fresh) {
    lost_.Add(seen.cycle, 1);
    cut_.Add(seen.cycle, 1);
    return;
  }
  const bool counted = seen.rig_session == held_session_ && seen.held_currents > held_before_;
  const std::uint32_t reported = (seen.rig_status & kRigCurrentHeld) != 0 ? 1 : 0;
  if (energised) {
    late_.Add(seen.cycle, counted ? seen.held_currents - held_before_ : reported);
  }
  held_before_ = seen.held_currents;
  held_session_ = seen.rig_session;
}

void Protections::CountBack(Counted& counted, std::uint64_t periods, std::uint64_t most) noexcept {
  if (counted.beyond) {
    counted.periods = std::min(counted.periods + periods, most);
  } else {
    counted.periods -= std::min(counted.periods, periods);
  }
}

// Periods that were skipped, and this one without a frame, go to what was seen last.
void Protections::CountMotion(const Observation& seen, const Circumstances& now) noexcept {
  const std::uint64_t unseen = std::uint64_t{seen.missed_deadlines} + (seen.fresh ? 0 : 1);
  const AxisArray deviation_m = Deviation(seen.position_m, now.reference_m);
  for (std::size_t b = 0; 2 * b < axes_; ++b) {
    CountBack(orbit_[b], unseen, config_.orbit_cycles);
    CountBack(contact_[b], unseen, contact_limit_cycles_);
    if (seen.fresh) {
      orbit_[b].beyond = Radius(deviation_m, b) > orbit_limit_m_[b];
      contact_[b].beyond = Radius(seen.position_m, b) >= clearance_m_[b];
      CountBack(orbit_[b], 1, config_.orbit_cycles);
      CountBack(contact_[b], 1, contact_limit_cycles_);
    }
    if (!now.energised) orbit_[b] = {};
  }
}

}  // namespace levitas::supervisor

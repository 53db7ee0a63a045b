#include "hil/can/assemblers.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace levitas::can {
namespace {

constexpr std::uint32_t kCycleMask = (1U << kCycleBits) - 1;
constexpr std::uint32_t kHalfRange = 1U << (kCycleBits - 1);

double WrapAngle(double angle_rad) noexcept {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const double wrapped = angle_rad - kTurn * std::floor(angle_rad / kTurn);
  return wrapped < kTurn ? wrapped : 0.0;
}

CurrentFrame FrameOf(const Values& values, std::uint64_t cycle, std::size_t axes) noexcept {
  return {.cycle = cycle,
          .axes = static_cast<std::uint32_t>(axes),
          .control_current_a = values.control_current_a,
          .bias_current_a = values.amplifiers_enabled ? values.bias_current_a : 0.0,
          .speed_set_point_rad_per_s = values.speed_set_point_rad_per_s,
          .acceleration_limit_rad_per_s2 = values.acceleration_limit_rad_per_s2,
          .amplifiers_enabled = values.amplifiers_enabled,
          .drive_enabled = values.drive_enabled};
}

}  // namespace

Inbox::Inbox(const Layout& layout, Sender sender) {
  entries_.reserve(layout.messages.size());
  for (const Message& message : layout.messages) {
    if (message.sender != sender) continue;
    std::uint32_t part = 0;
    if (message.every == 1) {
      part = all_parts_ + 1;  // the next bit: all_parts_ is 2^n - 1
      all_parts_ = 2 * all_parts_ + 1;
    }
    entries_.push_back(
        {.codec = MessageCodec(message, layout.format), .counter = {}, .part = part});
  }
}

Inbox::Entry* Inbox::Find(std::uint32_t id) noexcept {
  for (Entry& entry : entries_) {
    if (entry.codec.message().id == id) return &entry;
  }
  return nullptr;
}

RigAssembler::RigAssembler(const Layout& layout)
    : inbox_(layout, Sender::kRig),
      axes_(layout.axes),
      period_s_(static_cast<double>(layout.period_ns) * 1e-9),
      slow_rotation_(layout.format == Format::kClassical) {}

Outcome RigAssembler::Take(const WireFrame& wire, SensorFrame& frame) noexcept {
  const Outcome outcome = Judge(wire, frame);
  outcomes_.Count(outcome);
  return outcome;
}

Outcome RigAssembler::Judge(const WireFrame& wire, SensorFrame& frame) noexcept {
  Inbox::Entry* entry = inbox_.Find(wire.id);
  if (entry == nullptr) return Outcome::kForeign;
  Values values = values_;
  if (!entry->codec.Decode(wire, values)) return Outcome::kDamaged;
  const std::uint8_t counter = entry->codec.Counter(wire);
  if (entry->counter == counter && entry->cycle_low == values.cycle_low) return Outcome::kRepeated;
  entry->counter = counter;
  entry->cycle_low = values.cycle_low;
  if (entry->part == 0) {
    values_ = values;
    rotation_cycle_ = values.cycle_low;
    rotation_angle_rad_ = values.angle_rad;
    return Outcome::kPart;
  }
  const Values before = values_;
  values_ = values;
  const Outcome outcome = Sort(entry->part, frame);
  if (outcome == Outcome::kOutOfOrder) values_ = before;
  return outcome;
}

void RigAssembler::Restart() noexcept {
  started_ = true;
  ++session_;
  session_low_ = values_.session_low;
  cycle_ = values_.cycle_low;
  parts_ = 0;
  doubtful_ = 0;
  held_ = 0;
}

/// An older cycle may be a copy, or a rig that counts anew: the latter goes on from frame to frame.
bool RigAssembler::Confirmed(std::uint32_t low) noexcept {
  const bool follows = doubtful_ > 0 && ((low - doubtful_cycle_) & kCycleMask) <= 1;
  doubtful_ = follows ? doubtful_ + 1 : 1;
  doubtful_cycle_ = low;
  return doubtful_ >= kConfirm;
}

Outcome RigAssembler::Sort(std::uint32_t part, SensorFrame& frame) noexcept {
  const std::uint32_t low = values_.cycle_low;
  if (!started_ || values_.session_low != session_low_) {
    Restart();
  } else {
    const std::uint32_t step = (low - static_cast<std::uint32_t>(cycle_)) & kCycleMask;
    if (step >= kHalfRange) {
      if (!Confirmed(low)) return Outcome::kOutOfOrder;
      Restart();
    } else if (step > kLongestGap) {
      Restart();
    } else if (step > 0) {
      lost_ += step - 1 + (parts_ != 0 ? 1 : 0);
      cycle_ += step;
      parts_ = 0;
    }
  }
  doubtful_ = 0;
  if (parts_ == 0) part_cycle_ = low;
  parts_ |= part;
  if (parts_ != inbox_.all_parts()) return Outcome::kPart;
  parts_ = 0;
  return Complete(frame);
}

Outcome RigAssembler::Complete(SensorFrame& frame) noexcept {
  if ((values_.rig_status & kRigCurrentHeld) != 0) ++held_;
  double angle_rad = values_.angle_rad;
  if (slow_rotation_) {
    const std::uint32_t age = (values_.cycle_low - rotation_cycle_) & kCycleMask;
    angle_rad = WrapAngle(rotation_angle_rad_ + values_.speed_rad_per_s * age * period_s_);
  }
  frame = {.cycle = cycle_,
           .rig_session = session_,
           .rig_status = values_.rig_status,
           .held_currents = held_,
           .axes = static_cast<std::uint32_t>(axes_),
           .position_m = values_.position_m,
           .speed_rad_per_s = values_.speed_rad_per_s,
           .angle_rad = angle_rad};
  return Outcome::kFrame;
}

CommandAssembler::CommandAssembler(const Layout& layout)
    : inbox_(layout, Sender::kController), axes_(layout.axes) {}

Outcome CommandAssembler::Take(const WireFrame& wire, std::uint64_t own_cycle,
                               CurrentFrame& frame) noexcept {
  const Outcome outcome = Judge(wire, own_cycle, frame);
  outcomes_.Count(outcome);
  return outcome;
}

bool CommandAssembler::Finite() const noexcept {
  return std::all_of(values_.control_current_a.begin(), values_.control_current_a.end(),
                     [](double current) { return std::isfinite(current); });
}

Outcome CommandAssembler::Judge(const WireFrame& wire, std::uint64_t own_cycle,
                                CurrentFrame& frame) noexcept {
  Inbox::Entry* entry = inbox_.Find(wire.id);
  if (entry == nullptr) return Outcome::kForeign;
  Values values = values_;
  if (!entry->codec.Decode(wire, values)) return Outcome::kDamaged;
  const std::uint8_t counter = entry->codec.Counter(wire);
  if (entry->counter == counter && (entry->part == 0 || entry->cycle_low == values.cycle_low)) {
    return Outcome::kRepeated;
  }
  entry->counter = counter;
  entry->cycle_low = values.cycle_low;
  if (entry->part == 0) {
    if (!std::isfinite(values.speed_set_point_rad_per_s)) return Outcome::kDamaged;
    values_ = values;
    return Outcome::kPart;
  }
  const std::uint32_t age = (static_cast<std::uint32_t>(own_cycle) - values.cycle_low) & kCycleMask;
  if (age >= kHalfRange || age > own_cycle) return Outcome::kOutOfOrder;
  const std::uint64_t cycle = own_cycle - age;
  if (last_cycle_ && cycle < *last_cycle_) return Outcome::kOutOfOrder;
  if (parts_ != 0 && cycle != part_cycle_) parts_ = 0;
  values_ = values;
  if (!Finite()) {
    values_.control_current_a.fill(0.0);
    parts_ = 0;
    return Outcome::kDamaged;
  }
  part_cycle_ = cycle;
  parts_ |= entry->part;
  if (parts_ != inbox_.all_parts()) return Outcome::kPart;
  parts_ = 0;
  if (last_cycle_ && cycle > *last_cycle_ + 1) lost_ += cycle - *last_cycle_ - 1;
  last_cycle_ = cycle;
  frame = FrameOf(values_, cycle, axes_);
  return values_.goodbye ? Outcome::kGoodbye : Outcome::kFrame;
}

bool DriveSchedule::Due(const CurrentFrame& frame) noexcept {
  credit_periods_ = std::min(credit_periods_ + 1, kBurst * kDriveEvery);
  ++since_;
  const bool changed = frame.bias_current_a != bias_current_a_ ||
                       frame.speed_set_point_rad_per_s != speed_set_point_rad_per_s_ ||
                       frame.acceleration_limit_rad_per_s2 != acceleration_limit_rad_per_s2_;
  if (!(changed || since_ >= kDriveEvery) || credit_periods_ < kDriveEvery) return false;
  credit_periods_ -= kDriveEvery;
  since_ = 0;
  bias_current_a_ = frame.bias_current_a;
  speed_set_point_rad_per_s_ = frame.speed_set_point_rad_per_s;
  acceleration_limit_rad_per_s2_ = frame.acceleration_limit_rad_per_s2;
  return true;
}

}  // namespace levitas::can

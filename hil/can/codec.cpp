#include "hil/can/codec.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace levitas::can {
namespace {

constexpr std::uint32_t kSessionMask = 3;

// Eight bytes from `byte` on; beyond the payload there are zeros of the frame's own storage.
std::uint64_t Load(const std::array<std::uint8_t, kMaxPayload + 8>& data, std::size_t byte) {
  std::uint64_t word = 0;
  std::memcpy(&word, data.data() + byte, sizeof(word));
  return word;
}

void Store(std::array<std::uint8_t, kMaxPayload + 8>& data, std::size_t byte, std::uint64_t word) {
  std::memcpy(data.data() + byte, &word, sizeof(word));
}

std::uint64_t Bit(bool value) noexcept { return value ? 1U : 0U; }

/// The number of a field, for the fields that are numbers.
double Number(Field field, std::uint8_t axis, const Values& values) noexcept {
  switch (field) {
    case Field::kPosition:
      return values.position_m[axis];
    case Field::kCurrent:
      return values.control_current_a[axis];
    case Field::kSpeed:
      return values.speed_rad_per_s;
    case Field::kAngle:
      return values.angle_rad;
    case Field::kBias:
      return values.bias_current_a;
    case Field::kSpeedSetPoint:
      return values.speed_set_point_rad_per_s;
    default:
      return values.acceleration_limit_rad_per_s2;
  }
}

void SetNumber(Field field, std::uint8_t axis, double number, Values& values) noexcept {
  switch (field) {
    case Field::kPosition:
      values.position_m[axis] = number;
      break;
    case Field::kCurrent:
      values.control_current_a[axis] = number;
      break;
    case Field::kSpeed:
      values.speed_rad_per_s = number;
      break;
    case Field::kAngle:
      values.angle_rad = number;
      break;
    case Field::kBias:
      values.bias_current_a = number;
      break;
    case Field::kSpeedSetPoint:
      values.speed_set_point_rad_per_s = number;
      break;
    case Field::kAccelerationLimit:
      values.acceleration_limit_rad_per_s2 = number;
      break;
    default:  // no number: Take() sets it
      break;
  }
}

void SetStatus(std::uint32_t bit, std::uint64_t raw, Values& values) noexcept {
  values.rig_status = raw != 0 ? values.rig_status | bit : values.rig_status & ~bit;
}

}  // namespace

Values ValuesOf(const SensorFrame& frame) noexcept {
  Values values;
  values.position_m = frame.position_m;
  values.cycle_low = static_cast<std::uint32_t>(frame.cycle);
  values.session_low = frame.rig_session & kSessionMask;
  values.rig_status = frame.rig_status;
  values.speed_rad_per_s = frame.speed_rad_per_s;
  values.angle_rad = frame.angle_rad;
  return values;
}

Values ValuesOf(const CurrentFrame& frame, bool goodbye) noexcept {
  Values values;
  values.control_current_a = frame.control_current_a;
  values.cycle_low = static_cast<std::uint32_t>(frame.cycle);
  values.bias_current_a = frame.bias_current_a;
  values.speed_set_point_rad_per_s = frame.speed_set_point_rad_per_s;
  values.acceleration_limit_rad_per_s2 = frame.acceleration_limit_rad_per_s2;
  values.amplifiers_enabled = frame.amplifiers_enabled;
  values.drive_enabled = frame.drive_enabled;
  values.goodbye = goodbye;
  return values;
}

MessageCodec::MessageCodec(const Message& message, Format format)
    : message_(message), fd_(format == Format::kFd) {
  places_.reserve(message.signals.size());
  for (const Signal& signal : message.signals) {
    Place place{.field = signal.field,
                .axis = signal.axis,
                .byte = static_cast<std::uint16_t>(signal.start_bit / 8),
                .shift = static_cast<std::uint8_t>(signal.start_bit % 8),
                .is_signed = signal.is_signed,
                .mask = (std::uint64_t{1} << signal.bits) - 1,
                .factor = signal.factor,
                .steps_per_unit = 1.0 / signal.factor};
    place.high = static_cast<std::int64_t>(signal.is_signed ? place.mask >> 1U : place.mask);
    place.low = signal.is_signed ? -place.high : 0;
    places_.push_back(place);
  }
}

std::uint64_t MessageCodec::Raw(const Place& place, const Values& values) noexcept {
  switch (place.field) {
    case Field::kCycle:
      return values.cycle_low;
    case Field::kSession:
      return values.session_low;
    case Field::kEmergencyStop:
      return Bit((values.rig_status & kRigEmergencyStop) != 0);
    case Field::kAmplifierFault:
      return Bit((values.rig_status & kRigAmplifierFault) != 0);
    case Field::kCurrentHeld:
      return Bit((values.rig_status & kRigCurrentHeld) != 0);
    case Field::kAmplifiersOff:
      return Bit((values.rig_status & kRigAmplifiersOff) != 0);
    case Field::kAmplifiersEnabled:
      return Bit(values.amplifiers_enabled);
    case Field::kDriveEnabled:
      return Bit(values.drive_enabled);
    case Field::kGoodbye:
      return Bit(values.goodbye);
    default:
      break;
  }
  const double steps = Number(place.field, place.axis, values) * place.steps_per_unit;
  // The most negative step of a signed signal is kept for this.
  if (!std::isfinite(steps)) return static_cast<std::uint64_t>(place.is_signed ? place.low - 1 : 0);
  // An angle that rounds up to the whole turn is the angle zero again.
  if (place.field == Field::kAngle) return static_cast<std::uint64_t>(std::lrint(steps));
  const double within =
      std::clamp(steps, static_cast<double>(place.low), static_cast<double>(place.high));
  return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::lrint(within)));
}

void MessageCodec::Take(const Place& place, std::uint64_t raw, Values& values) noexcept {
  auto whole = static_cast<std::int64_t>(raw);
  if (place.is_signed && whole > place.high) whole -= static_cast<std::int64_t>(place.mask) + 1;
  const double number = place.is_signed && whole < place.low
                            ? std::numeric_limits<double>::quiet_NaN()
                            : static_cast<double>(whole) * place.factor;
  switch (place.field) {
    case Field::kCycle:
      values.cycle_low = static_cast<std::uint32_t>(raw);
      break;
    case Field::kSession:
      values.session_low = static_cast<std::uint32_t>(raw);
      break;
    case Field::kEmergencyStop:
      SetStatus(kRigEmergencyStop, raw, values);
      break;
    case Field::kAmplifierFault:
      SetStatus(kRigAmplifierFault, raw, values);
      break;
    case Field::kCurrentHeld:
      SetStatus(kRigCurrentHeld, raw, values);
      break;
    case Field::kAmplifiersOff:
      SetStatus(kRigAmplifiersOff, raw, values);
      break;
    case Field::kAmplifiersEnabled:
      values.amplifiers_enabled = raw != 0;
      break;
    case Field::kDriveEnabled:
      values.drive_enabled = raw != 0;
      break;
    case Field::kGoodbye:
      values.goodbye = raw != 0;
      break;
    case Field::kPosition:
    case Field::kCurrent:
    case Field::kSpeed:
    case Field::kAngle:
    case Field::kBias:
    case Field::kSpeedSetPoint:
    case Field::kAccelerationLimit:
      SetNumber(place.field, place.axis, number, values);
      break;
  }
}

WireFrame MessageCodec::Encode(const Values& values) noexcept {
  std::array<std::uint8_t, kMaxPayload + 8> data{};
  for (const Place& place : places_) {
    const std::uint64_t bits = (Raw(place, values) & place.mask) << place.shift;
    Store(data, place.byte, Load(data, place.byte) | bits);
  }
  WireFrame frame;
  frame.id = message_.id;
  frame.length = message_.bytes;
  frame.fd = fd_;
  std::copy_n(data.begin(), kMaxPayload, frame.data.begin());
  Protect(message_.profile, message_.data_id(), static_cast<std::uint8_t>(counter_),
          frame.payload());
  counter_ = (counter_ + 1) % CounterModulus(message_.profile);
  return frame;
}

bool MessageCodec::Decode(const WireFrame& frame, Values& values) const noexcept {
  if (frame.id != message_.id || frame.length != message_.bytes || frame.fd != fd_ ||
      !Intact(message_.profile, message_.data_id(), frame.payload())) {
    return false;
  }
  std::array<std::uint8_t, kMaxPayload + 8> data{};
  std::copy_n(frame.data.begin(), kMaxPayload, data.begin());
  for (const Place& place : places_) {
    Take(place, (Load(data, place.byte) >> place.shift) & place.mask, values);
  }
  return true;
}

}  // namespace levitas::can

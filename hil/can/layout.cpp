#include "hil/can/layout.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "hil/can/wire_frame.hpp"

namespace levitas::can {
namespace {

constexpr unsigned kNumberBits = 16;
constexpr unsigned kSpeedBits = 18;
constexpr unsigned kBiasBits = 12;
constexpr double kFinestPositionM = 1e-8;
constexpr double kFinestCurrentA = 1e-4;
constexpr double kFinestBiasA = 1e-3;
constexpr double kFinestSpeedRadPerS = 0.1;
constexpr double kFinestAccelerationRadPerS2 = 0.1;
// A speed is to be readable beyond its trip.
constexpr double kSpeedReserve = 1.5;
// Rigs with a faster drive are not known; a set-point beyond it would be cut.
constexpr double kFastestDriveRadPerS2 = 26'000.0;

/// The first of finest x 1, 2, 5, 10 ... that covers `range` with `steps` steps.
double Factor(double finest, double range, double steps) {
  constexpr std::array kSteps{1.0, 2.0, 5.0};
  double decade = 1.0;
  for (int power = 0; power < 12; ++power) {
    for (const double step : kSteps) {
      const double factor = finest * (step * decade);
      if (factor * steps >= range) return factor;
    }
    decade *= 10.0;
  }
  throw std::invalid_argument("CAN layout: no scale covers " + std::to_string(range));
}

double SignedSteps(unsigned bits) { return std::ldexp(1.0, static_cast<int>(bits) - 1) - 1.0; }
double UnsignedSteps(unsigned bits) { return std::ldexp(1.0, static_cast<int>(bits)) - 1.0; }

/// Appends signals one behind the other.
class Builder {
 public:
  Builder(std::string name, std::uint32_t id, Sender sender, std::uint32_t every) {
    message_.name = std::move(name);
    message_.id = id;
    message_.sender = sender;
    message_.every = every;
  }

  void Flag(const char* name, Field field, const char* meaning) {
    Add({.name = name, .field = field, .bits = 1, .meaning = meaning});
  }
  void Gap(unsigned bits) { bits_ += bits; }
  void Add(Signal signal) {
    signal.start_bit = static_cast<std::uint16_t>(bits_);
    bits_ += signal.bits;
    message_.signals.push_back(std::move(signal));
  }
  void CarriesAxis() { ++message_.axes; }

  /// Closes the message: the protection takes the first bits, everything moves behind it.
  [[nodiscard]] Message Finish() {
    const auto bytes_with = [&](Profile profile) {
      return (ProtectionBits(profile) + bits_ + 7U) / 8U;
    };
    message_.profile = bytes_with(Profile::k11) <= 16 ? Profile::k11 : Profile::k5;
    message_.bytes = PayloadLength(bytes_with(message_.profile));
    for (Signal& signal : message_.signals) {
      signal.start_bit =
          static_cast<std::uint16_t>(signal.start_bit + ProtectionBits(message_.profile));
    }
    return std::move(message_);
  }

 private:
  Message message_;
  unsigned bits_{0};
};

Signal CycleSignal() {
  return {.name = "cycle",
          .field = Field::kCycle,
          .bits = kCycleBits,
          .meaning = "low bits of the rig's count of sampling instants"};
}

Signal SpeedSignal(const char* name, Field field, double factor) {
  return {.name = name,
          .field = field,
          .bits = kSpeedBits,
          .is_signed = true,
          .factor = factor,
          .unit = "rad/s",
          .meaning = "rotation, positive from x to y"};
}

Signal AngleSignal() {
  return {.name = "angle",
          .field = Field::kAngle,
          .bits = kNumberBits,
          .factor = 2.0 * std::numbers::pi / 65536.0,
          .unit = "rad",
          .meaning = "of the rotor at the sampling instant"};
}

class Table {
 public:
  Table(const RigNumbers& rig, Format format)
      : rig_(rig),
        classical_(format == Format::kClassical),
        position_factor_(
            Factor(kFinestPositionM, rig.LargestSensorRange(), SignedSteps(kNumberBits))),
        current_factor_(Factor(kFinestCurrentA, rig.max_coil_current_a, SignedSteps(kNumberBits))),
        speed_factor_(Factor(kFinestSpeedRadPerS, kSpeedReserve * rig.max_speed_rad_per_s,
                             SignedSteps(kSpeedBits))) {
    layout_.format = format;
    layout_.axes = rig.axes();
    layout_.period_ns = rig.period_ns;
  }

  [[nodiscard]] Layout Make() {
    const std::size_t step = classical_ ? 2 : rig_.axes();
    for (std::size_t first = 0; first < rig_.axes(); first += step) {
      const std::size_t last = std::min(first + step, rig_.axes());
      layout_.messages.push_back(Currents(first, last));
      layout_.messages.push_back(Positions(first, last));
    }
    layout_.messages.push_back(Drive());
    if (classical_) layout_.messages.push_back(Rotation());
    std::stable_sort(layout_.messages.begin(), layout_.messages.end(),
                     [](const Message& a, const Message& b) { return a.id < b.id; });
    return std::move(layout_);
  }

 private:
  [[nodiscard]] std::string Numbered(const char* name, std::size_t first) const {
    return classical_ ? name + std::to_string(first / 2 + 1) : name;
  }
  [[nodiscard]] std::uint32_t Id(std::uint32_t base, std::size_t first) const {
    return base + static_cast<std::uint32_t>(classical_ ? first / 2 : 0);
  }

  void Axis(Builder& builder, Field field, std::size_t axis) const {
    const bool position = field == Field::kPosition;
    builder.Add({.name = (position ? "position_" : "current_") + rig_.channels[axis],
                 .field = field,
                 .axis = static_cast<std::uint8_t>(axis),
                 .bits = kNumberBits,
                 .is_signed = true,
                 .factor = position ? position_factor_ : current_factor_,
                 .unit = position ? "m" : "A",
                 .meaning = position ? "as the probe reads it" : "control current ic"});
    builder.CarriesAxis();
  }

  [[nodiscard]] Message Positions(std::size_t first, std::size_t last) const {
    Builder builder(Numbered("RigPositions", first), Id(kPositionsId, first), Sender::kRig, 1);
    builder.Flag("emergency_stop", Field::kEmergencyStop, "the rig's stop chain is open");
    builder.Flag("amplifier_fault", Field::kAmplifierFault, "an amplifier reports a fault");
    builder.Flag("current_held", Field::kCurrentHeld, "no new current came in time");
    builder.Flag("amplifiers_off", Field::kAmplifiersOff, "amplifiers are de-energised");
    for (std::size_t axis = first; axis < last; ++axis) Axis(builder, Field::kPosition, axis);
    builder.Add(CycleSignal());
    builder.Add({.name = "session",
                 .field = Field::kSession,
                 .bits = 2,
                 .meaning = "drawn anew at each start of the rig"});
    if (!classical_) {
      builder.Add(SpeedSignal("speed", Field::kSpeed, speed_factor_));
      builder.Add(AngleSignal());
    }
    return builder.Finish();
  }

  [[nodiscard]] Message Currents(std::size_t first, std::size_t last) const {
    Builder builder(Numbered("ControllerCurrents", first), Id(kCurrentsId, first),
                    Sender::kController, 1);
    builder.Flag("amplifiers_enabled", Field::kAmplifiersEnabled,
                 "0: both coils of every axis are de-energised");
    builder.Flag("drive_enabled", Field::kDriveEnabled, "0: the drive gives no torque");
    builder.Flag("goodbye", Field::kGoodbye, "the controller ends; nothing follows");
    builder.Gap(1);
    for (std::size_t axis = first; axis < last; ++axis) Axis(builder, Field::kCurrent, axis);
    builder.Add(CycleSignal());
    return builder.Finish();
  }

  [[nodiscard]] Message Drive() const {
    Builder builder("ControllerDrive", kDriveId, Sender::kController, kDriveEvery);
    builder.Gap(4);
    builder.Add({.name = "bias_current",
                 .field = Field::kBias,
                 .bits = kBiasBits,
                 .factor = Factor(kFinestBiasA, rig_.max_coil_current_a, UnsignedSteps(kBiasBits)),
                 .unit = "A",
                 .meaning = "i0; coils carry i0 + ic and i0 - ic"});
    builder.Add(SpeedSignal("speed_set_point", Field::kSpeedSetPoint, speed_factor_));
    builder.Add({.name = "acceleration_limit",
                 .field = Field::kAccelerationLimit,
                 .bits = kSpeedBits,
                 .factor = Factor(kFinestAccelerationRadPerS2, kFastestDriveRadPerS2,
                                  UnsignedSteps(kSpeedBits)),
                 .unit = "rad/s^2",
                 .meaning = "of the drive"});
    return builder.Finish();
  }

  [[nodiscard]] Message Rotation() const {
    Builder builder("RigRotation", kRotationId, Sender::kRig, kRotationEvery);
    builder.Gap(4);
    builder.Add(CycleSignal());
    builder.Add(SpeedSignal("speed", Field::kSpeed, speed_factor_));
    builder.Add(AngleSignal());
    return builder.Finish();
  }

  const RigNumbers& rig_;
  bool classical_;
  double position_factor_;
  double current_factor_;
  double speed_factor_;
  Layout layout_;
};

}  // namespace

Layout MakeLayout(const RigNumbers& rig, Format format) {
  if (rig.axes() == 0 || rig.axes() > kMaxAxes) {
    throw std::invalid_argument("CAN layout: " + std::to_string(rig.axes()) +
                                " axes, allowed 1 to " + std::to_string(kMaxAxes));
  }
  return Table(rig, format).Make();
}

Format FormatOf(const std::vector<BusConfig>& buses) {
  const auto fast = [](const BusConfig& bus) { return bus.rates.data_bit_per_s > 0.0; };
  const auto count = std::count_if(buses.begin(), buses.end(), fast);
  if (count != 0 && count != static_cast<std::ptrdiff_t>(buses.size())) {
    throw std::invalid_argument("CAN buses of one rig are all CAN FD or all classical");
  }
  return count == 0 ? Format::kClassical : Format::kFd;
}

std::size_t BusOf(const Message& message, const std::vector<BusConfig>& buses) {
  const Carries wanted = message.sender == Sender::kRig ? Carries::kFromRig : Carries::kToRig;
  for (std::size_t at = 0; at < buses.size(); ++at) {
    if (buses[at].carries == wanted || buses[at].carries == Carries::kEverything) return at;
  }
  throw std::invalid_argument("CAN buses: none carries " + message.name);
}

}  // namespace levitas::can

#pragma once
// Words that cross layers and processes: modes, faults, operator commands.
// The numeric values are part of the message contract: they may be added to, never renumbered.

#include <cstdint>
#include <string_view>

namespace levitas {

enum class Mode : std::uint8_t {
  kOff = 0,
  kSelfTest = 1,
  kLift = 2,
  kLevitating = 3,
  kSpinning = 4,
  kCoastDown = 5,
  kLanding = 6,
  kTripped = 7,
};
inline constexpr std::uint8_t kModeCount = 8;

enum class Fault : std::uint8_t {
  kNone = 0,
  kOrbitExceeded = 1,
  kSensorOutOfRange = 2,
  kSensorFrozen = 3,
  kSensorNotFinite = 4,
  kFrameMissing = 5,
  kDeadlineMissed = 6,
  kCoilSaturated = 7,
  kOverSpeed = 8,
  kEmergencyStop = 9,
  kRigRestarted = 10,
  kAmplifierFault = 11,
  kSelfTestFailed = 12,
  kLiftFailed = 13,
  kSpeedUnknown = 14,
  kLawNotFinite = 15,
  kFramesLost = 16,
  kCurrentsLate = 17,
};
inline constexpr std::uint8_t kFaultCount = 18;

/// What an operator (or a scenario) asks for. Requests that the mode table does not allow are
/// refused and reported, never queued.
enum class OperatorCommand : std::uint8_t {
  kNone = 0,
  kLift = 1,           ///< off -> self-test -> lift -> levitating
  kSpin = 2,           ///< go to the speed set point with the given acceleration
  kCoastDown = 3,      ///< drive off, stay levitated
  kLand = 4,           ///< at standstill: lower into the touchdown bearings, amplifiers off
  kEmergencyStop = 5,  ///< latched trip
  kReset = 6,          ///< acknowledge a trip; tripped -> off
  kExcite = 7,         ///< a test signal begins with the next cycle
  kEndExcitation = 8,  ///< no test signal from this cycle on
  kMark = 9,           ///< asks for nothing: an instant that somebody wants to find again
};
inline constexpr std::uint8_t kOperatorCommandCount = 10;

// Stable lower_snake_case names ("levitating", "orbit_exceeded", "spin"); "invalid" beyond the end.
[[nodiscard]] std::string_view Name(Mode mode) noexcept;
[[nodiscard]] std::string_view Name(Fault fault) noexcept;
[[nodiscard]] std::string_view Name(OperatorCommand command) noexcept;

}  // namespace levitas

#pragma once
// The one table of the bus: every message with its identifier, period and protection, every signal
// with its place, scale and range. Codec, DBC file, bus budget and documentation are made from it.
//
// Bits        little-endian ("Intel"): bit n is bit n % 8 of byte n / 8.
// Scale       raw x factor = SI value. The factor is the smallest of 1-2-5 steps (10 nm and 0.1 mA
//             at least) with which 16 bits cover the sensor range and the coil current of the rig.
// Absent      a signed signal at its most negative raw value carries "not a number".
// Cycle       12 bits of the rig's count; the receiver completes them (assemblers.hpp).
// Classical   two axes a frame, rotation in a frame of its own: 8 bytes hold no more.
// Identifier  lower wins the bus: currents, positions, drive, rotation. The Data ID of the
//             protection is the identifier.
// Failure     MakeLayout throws std::invalid_argument for a rig without axes or with too many.

#include <cstdint>
#include <string>
#include <vector>

#include "common/rig_numbers.hpp"
#include "hil/can/bus_config.hpp"
#include "hil/can/protection.hpp"

namespace levitas::can {

enum class Sender : std::uint8_t { kRig, kController };
enum class Format : std::uint8_t { kFd, kClassical };

/// What a signal means; numbers per axis carry the axis beside it.
enum class Field : std::uint8_t {
  kPosition,
  kCurrent,
  kCycle,
  kSession,
  kSpeed,
  kAngle,
  kEmergencyStop,
  kAmplifierFault,
  kCurrentHeld,
  kAmplifiersOff,
  kAmplifiersEnabled,
  kDriveEnabled,
  kGoodbye,
  kBias,
  kSpeedSetPoint,
  kAccelerationLimit,
};

struct Signal {
  std::string name;
  Field field{};
  std::uint8_t axis{};
  std::uint16_t start_bit{};
  std::uint8_t bits{};
  bool is_signed{};
  double factor{1.0};
  std::string unit{};
  std::string meaning{};
};

struct Message {
  std::string name;
  std::uint32_t id{};
  Sender sender{};
  std::uint32_t every{1};  ///< periods between two; slow ones also at once after a change
  Profile profile{};
  std::uint8_t bytes{};
  std::vector<Signal> signals;
  std::uint8_t axes{};  ///< how many axes it carries; 0: none

  [[nodiscard]] std::uint16_t data_id() const noexcept { return static_cast<std::uint16_t>(id); }
};

struct Layout {
  Format format{};
  std::size_t axes{};
  std::int64_t period_ns{};
  std::vector<Message> messages;
};

inline constexpr std::uint32_t kCurrentsId = 0x100;
inline constexpr std::uint32_t kPositionsId = 0x110;
inline constexpr std::uint32_t kDriveId = 0x120;
inline constexpr std::uint32_t kRotationId = 0x128;
inline constexpr unsigned kCycleBits = 12;
inline constexpr std::uint32_t kDriveEvery = 16;
inline constexpr std::uint32_t kRotationEvery = 4;  ///< classical only

[[nodiscard]] Layout MakeLayout(const RigNumbers& rig, Format format);

/// FD when the buses have a data rate. Buses of both kinds: std::invalid_argument.
[[nodiscard]] Format FormatOf(const std::vector<BusConfig>& buses);

/// Index of the bus that carries a message, of the first that does.
[[nodiscard]] std::size_t BusOf(const Message& message, const std::vector<BusConfig>& buses);

}  // namespace levitas::can

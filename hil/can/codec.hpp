#pragma once
// Frames of the loop to CAN frames and back, by the table of layout.hpp.
//
// Rounding   to the nearest step; numbers beyond the range of a signal become its last step, and
//            what is not finite becomes "absent", which decodes to NaN.
// Not carried  the time of sampling, the rig's count of held currents and its full session number
//            and cycle: the receiver completes them (see assemblers.hpp).
// Thread     one per object; no allocation after construction, no exception.
// Failure    Decode is false unless length, format and checksum are those of the message; then its
//            argument is untouched.

#include <cstdint>
#include <optional>
#include <vector>

#include "common/frames.hpp"
#include "hil/can/layout.hpp"
#include "hil/can/wire_frame.hpp"

namespace levitas::can {

/// All that one message can hold, decoded; each message fills its own part.
struct Values {
  AxisArray position_m{};
  AxisArray control_current_a{};
  std::uint32_t cycle_low{};
  std::uint32_t session_low{};
  std::uint32_t rig_status{};
  double speed_rad_per_s{};
  double angle_rad{};
  double bias_current_a{};
  double speed_set_point_rad_per_s{};
  double acceleration_limit_rad_per_s2{};
  bool amplifiers_enabled{};
  bool drive_enabled{};
  bool goodbye{};
};

[[nodiscard]] Values ValuesOf(const SensorFrame& frame) noexcept;
[[nodiscard]] Values ValuesOf(const CurrentFrame& frame, bool goodbye) noexcept;

/// One message of a layout.
class MessageCodec {
 public:
  MessageCodec(const Message& message, Format format);

  /// Counts the alive counter on.
  [[nodiscard]] WireFrame Encode(const Values& values) noexcept;
  /// Reads the message's signals into `values`, leaving the others.
  [[nodiscard]] bool Decode(const WireFrame& frame, Values& values) const noexcept;

  [[nodiscard]] const Message& message() const noexcept { return message_; }
  /// Alive counter of an intact frame.
  [[nodiscard]] std::uint8_t Counter(const WireFrame& frame) const noexcept {
    return CounterOf(message_.profile, frame.payload());
  }

 private:
  struct Place {
    Field field{};
    std::uint8_t axis{};
    std::uint16_t byte{};
    std::uint8_t shift{};
    bool is_signed{};
    std::uint64_t mask{};
    std::int64_t low{};
    std::int64_t high{};
    double factor{};
    double steps_per_unit{};
  };
  [[nodiscard]] static std::uint64_t Raw(const Place& place, const Values& values) noexcept;
  static void Take(const Place& place, std::uint64_t raw, Values& values) noexcept;

  Message message_;
  bool fd_;
  std::vector<Place> places_;
  std::uint32_t counter_{0};
};

}  // namespace levitas::can

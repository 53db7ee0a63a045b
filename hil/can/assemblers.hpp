#pragma once
// From CAN frames to whole frames of the loop: order, repetition, loss and restarts are judged
// here.
//
// Cycle      messages carry its low 12 bits. The controller's end counts on from the last one it
//            took; the rig's end knows its own count.
// Repeated   same counter, same cycle: a copy, ignored. Same cycle under another counter: the rig
//            asks again, which is passed on.
// Order      an older cycle than the last one taken is refused. kConfirm of them in a row, each
//            following the one before, are a rig that counts anew: a restart, as is another session
//            number, or a jump ahead by more than kLongestGap periods.
// Blind spot a copy of a message older than 4096 periods, of just the right counter and cycle, is
//            taken for new (12 bits of cycle and 4 of counter: 1 in 61 440 periods).
// Thread     one per object; no allocation after construction, no exception.

#include <cstdint>
#include <optional>
#include <vector>

#include "common/frames.hpp"
#include "hil/can/codec.hpp"

namespace levitas::can {

/// What became of one CAN frame.
enum class Outcome : std::uint8_t {
  kForeign,     ///< not a message for this end
  kDamaged,     ///< length, checksum or counter wrong, or a current that is no number
  kRepeated,    ///< a copy of the last one
  kOutOfOrder,  ///< older than what was taken
  kPart,        ///< taken; more messages belong to the same frame
  kFrame,       ///< a whole frame was written to the argument
  kGoodbye,     ///< rig's end: the controller ends; the argument is its last frame
};
inline constexpr std::size_t kOutcomeCount = 7;

/// Counts how often each outcome occurred.
struct OutcomeCounters {
  std::array<std::uint64_t, kOutcomeCount> of{};
  void Count(Outcome outcome) noexcept { ++of[static_cast<std::size_t>(outcome)]; }
  [[nodiscard]] std::uint64_t operator[](Outcome outcome) const noexcept {
    return of[static_cast<std::size_t>(outcome)];
  }
};

/// The messages of one sender with their codecs and the counters last seen.
class Inbox {
 public:
  Inbox(const Layout& layout, Sender sender);
  struct Entry {
    MessageCodec codec;
    std::optional<std::uint8_t> counter;
    std::uint32_t cycle_low{};
    std::uint32_t part{};  ///< bit of this message in a whole frame; 0 for slow messages
  };
  [[nodiscard]] Entry* Find(std::uint32_t id) noexcept;
  [[nodiscard]] std::uint32_t all_parts() const noexcept { return all_parts_; }

 private:
  std::vector<Entry> entries_;
  std::uint32_t all_parts_{0};
};

/// Controller's end: sensor frames.
class RigAssembler {
 public:
  static constexpr std::uint32_t kLongestGap = 256;
  static constexpr std::uint32_t kConfirm = 3;

  explicit RigAssembler(const Layout& layout);

  /// The frame's sample_time_ns is left to the caller.
  [[nodiscard]] Outcome Take(const WireFrame& wire, SensorFrame& frame) noexcept;
  /// Cycles of the rig of which no whole frame came.
  [[nodiscard]] std::uint64_t lost() const noexcept { return lost_; }
  [[nodiscard]] const OutcomeCounters& outcomes() const noexcept { return outcomes_; }

 private:
  [[nodiscard]] Outcome Judge(const WireFrame& wire, SensorFrame& frame) noexcept;
  [[nodiscard]] Outcome Sort(std::uint32_t part, SensorFrame& frame) noexcept;
  [[nodiscard]] bool Confirmed(std::uint32_t low) noexcept;
  void Restart() noexcept;
  [[nodiscard]] Outcome Complete(SensorFrame& frame) noexcept;

  Inbox inbox_;
  std::size_t axes_;
  double period_s_;
  bool slow_rotation_;
  Values values_;
  std::uint32_t parts_{0};
  std::uint32_t part_cycle_{0};
  std::uint32_t rotation_cycle_{0};
  double rotation_angle_rad_{0.0};
  bool started_{false};
  std::uint64_t cycle_{0};
  std::uint32_t session_low_{0};
  std::uint32_t session_{0};
  std::uint32_t doubtful_{0};
  std::uint32_t doubtful_cycle_{0};
  std::uint32_t held_{0};
  std::uint64_t lost_{0};
  OutcomeCounters outcomes_;
};

/// Rig's end: current frames. Bias, set-point and acceleration are those of the last drive message.
class CommandAssembler {
 public:
  explicit CommandAssembler(const Layout& layout);

  /// `own_cycle` is the cycle of the latest sensor frame.
  [[nodiscard]] Outcome Take(const WireFrame& wire, std::uint64_t own_cycle,
                             CurrentFrame& frame) noexcept;
  [[nodiscard]] std::uint64_t lost() const noexcept { return lost_; }
  [[nodiscard]] const OutcomeCounters& outcomes() const noexcept { return outcomes_; }

 private:
  [[nodiscard]] Outcome Judge(const WireFrame& wire, std::uint64_t own_cycle,
                              CurrentFrame& frame) noexcept;
  [[nodiscard]] bool Finite() const noexcept;

  Inbox inbox_;
  std::size_t axes_;
  Values values_;
  std::uint32_t parts_{0};
  std::uint64_t part_cycle_{0};
  std::optional<std::uint64_t> last_cycle_;
  std::uint64_t lost_{0};
  OutcomeCounters outcomes_;
};

/// When the slow drive message goes out: every kDriveEvery periods, and at once after a change as
/// long as the average stays within that.
class DriveSchedule {
 public:
  [[nodiscard]] bool Due(const CurrentFrame& frame) noexcept;

 private:
  static constexpr std::uint32_t kBurst = 2;
  double bias_current_a_{};
  double speed_set_point_rad_per_s_{};
  double acceleration_limit_rad_per_s2_{};
  std::uint32_t since_{kDriveEvery};
  std::uint32_t credit_periods_{kBurst * kDriveEvery};
};

}  // namespace levitas::can

#pragma once
// The heartbeat: a square wave that only a running cycle makes, and what the rig makes of it.
//
// Why        a line that is merely high says nothing: a processor that hangs leaves it high. The
//            rig lets current flow only while it sees edges, as a charge pump in the enable
//            circuit does: no edge, no voltage, no amplifier.
// Units      cycles at the sender, nanoseconds at the receiver.
// Thread     one owner each. No allocation, no failure.
// Not done   frequency is not judged: a sender that toggles too fast counts as alive.

#include <cstdint>

namespace levitas::gpio {

/// Sender: one Step per cycle; the level changes every `toggle_cycles`.
class Heartbeat {
 public:
  explicit Heartbeat(std::uint32_t toggle_cycles) noexcept
      : toggle_cycles_(toggle_cycles == 0 ? 1 : toggle_cycles) {}

  /// True when the level has changed in this cycle.
  bool Step() noexcept {
    if (++since_edge_ < toggle_cycles_) return false;
    since_edge_ = 0;
    level_ = !level_;
    return true;
  }
  [[nodiscard]] bool level() const noexcept { return level_; }

 private:
  std::uint32_t toggle_cycles_;
  std::uint32_t since_edge_{0};
  bool level_{false};
};

/// Receiver: alive from the second edge until `timeout_ns` passed without one.
class HeartbeatWatch {
 public:
  explicit HeartbeatWatch(std::int64_t timeout_ns) noexcept : timeout_ns_(timeout_ns) {}

  /// Looks at the level at `now_ns`; returns whether the sender lives.
  bool Sample(bool level, std::int64_t now_ns) noexcept {
    const bool edge = known_ && level != level_;
    // The first edge after a silence may be the end of whatever held the line: wait for another.
    if (edge) {
      alive_ = now_ns - last_edge_ns_ <= timeout_ns_ && edges_ > 0;
      ++edges_;
      last_edge_ns_ = now_ns;
    } else if (edges_ == 0 || now_ns - last_edge_ns_ > timeout_ns_) {
      alive_ = false;
    }
    known_ = true;
    level_ = level;
    return alive_;
  }
  [[nodiscard]] bool alive() const noexcept { return alive_; }
  [[nodiscard]] std::uint64_t edges() const noexcept { return edges_; }

 private:
  std::int64_t timeout_ns_;
  std::int64_t last_edge_ns_{0};
  std::uint64_t edges_{0};
  bool level_{false};
  bool known_{false};
  bool alive_{false};
};

}  // namespace levitas::gpio

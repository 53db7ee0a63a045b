#pragma once
// The rig's own say over its amplifiers: they drive current only while the enable line is active
// and the heartbeat lives, whatever the frames of the bus ask for.
//
// Latch     a heartbeat that was lost while enabled keeps the gate shut until the enable line has
//           been inactive: a controller that comes back from a hang must begin anew.
// Units     nanoseconds.
// Thread    one owner. No allocation, no failure.
// Absent    a line that is not there does not shut the gate.

#include <cstdint>
#include <optional>

#include "hil/gpio/heartbeat.hpp"

namespace levitas::gpio {

enum class GateEvent : std::uint8_t {
  kNone = 0,
  kOpened = 1,         ///< amplifiers may drive current from here on
  kEnableFell = 2,     ///< shut: the enable line became inactive
  kHeartbeatLost = 3,  ///< shut: no edge for too long while the enable line was active
};

class RigGate {
 public:
  /// nullopt: no heartbeat line.
  explicit RigGate(std::optional<std::int64_t> heartbeat_timeout_ns) noexcept {
    if (heartbeat_timeout_ns) watch_.emplace(*heartbeat_timeout_ns);
  }

  GateEvent Sample(bool enable, bool heartbeat, std::int64_t now_ns) noexcept {
    const bool alive = !watch_ || watch_->Sample(heartbeat, now_ns);
    if (!enable) latched_ = false;
    if (open_ && !alive) {
      latched_ = enable;
      open_ = false;
      return enable ? GateEvent::kHeartbeatLost : GateEvent::kEnableFell;
    }
    const bool was_open = open_;
    open_ = enable && alive && !latched_;
    if (open_ == was_open) return GateEvent::kNone;
    return open_ ? GateEvent::kOpened : GateEvent::kEnableFell;
  }
  [[nodiscard]] bool open() const noexcept { return open_; }

 private:
  std::optional<HeartbeatWatch> watch_;
  bool open_{false};
  bool latched_{false};
};

}  // namespace levitas::gpio

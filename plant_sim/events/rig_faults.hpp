#pragma once
// Faults of a rig's parts at the times a scenario gives: what the rig's frames look like then.
//
// Frame    readings as the probes are wired, like those of the frame itself.
// Time     cycles of the rig since the controller's first answer; a fault acts in every cycle n
//          with at <= n T < at + duration.
// Thread   one; Disturb allocates nothing, locks nothing, throws nothing.
// Failure  the constructor throws std::invalid_argument for a period that is not positive or an
//          axis beyond kMaxAxes.
// Not done effects and torques (RigEventKind::kEffect, kTorque): those are the plant's own.

#include <cstdint>
#include <vector>

#include "common/frames.hpp"
#include "common/rig_events.hpp"

namespace levitas::events {

class RigFaults {
 public:
  RigFaults(const std::vector<ScheduledRigEvent>& events, double period_s);

  /// Changes a frame that is about to leave. Call once per cycle, in order.
  void Disturb(std::uint64_t cycle, SensorFrame& frame) noexcept;

  [[nodiscard]] bool empty() const noexcept { return faults_.empty(); }

 private:
  struct Fault {
    RigEventKind kind{};
    std::uint64_t first{};
    std::uint64_t end{};
    std::size_t axis{};
    double value_m{};
    double frozen_m{};
    bool frozen{};
  };

  std::vector<Fault> faults_;
};

}  // namespace levitas::events

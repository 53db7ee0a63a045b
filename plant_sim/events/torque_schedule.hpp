#pragma once
// Torques from outside at the times a scenario gives: what acts on which inertia in which cycle.
//
// Equation  an event's torque rises in a straight line within `ramp` from the cycle at `at` on,
//           stays, and falls within `ramp` from `at + duration` on; without a ramp at once, with
//           duration 0 it stays for good. A cycle has one value: an impact is sampled like
//           everything else. Torques on one inertia add up.
// Sign      positive in the sense in which the first shaft turns.
// Use       Apply(cycle, set) calls set(index, torque_n_m) for every inertia whose torque is not
//           what it was in the call before.
// Thread    one; Apply allocates nothing, throws nothing.
// Failure   the constructor throws std::invalid_argument for an inertia that the rig does not have
//           or has twice, and for a period that is not positive.

#include <cstdint>
#include <string>
#include <vector>

#include "common/rig_events.hpp"

namespace levitas::events {

class TorqueSchedule {
 public:
  /// `inertias` are the names of the rig's, in order.
  TorqueSchedule(const std::vector<ScheduledRigEvent>& events,
                 const std::vector<std::string>& inertias, double period_s);

  template <class Set>
  void Apply(std::uint64_t cycle, Set set) noexcept {
    for (Inertia& inertia : acted_on_) {
      double torque_n_m = 0.0;
      for (const Torque& torque : torques_) {
        if (torque.index == inertia.index) torque_n_m += torque.At(cycle);
      }
      if (torque_n_m == inertia.torque_n_m) continue;
      inertia.torque_n_m = torque_n_m;
      set(inertia.index, torque_n_m);
    }
  }

  [[nodiscard]] bool empty() const noexcept { return torques_.empty(); }

 private:
  struct Torque {
    [[nodiscard]] double At(std::uint64_t cycle) const noexcept;
    std::size_t index{};
    std::uint64_t first{}, end{}, ramp_cycles{};
    double torque_n_m{};
  };
  struct Inertia {
    std::size_t index{};
    double torque_n_m{};
  };

  std::vector<Torque> torques_;
  std::vector<Inertia> acted_on_;
};

}  // namespace levitas::events

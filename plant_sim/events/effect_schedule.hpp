#pragma once
// Changes of effects at the times a scenario gives: which entry has which strength in which cycle.
//
// Equation  from the cycle at `at` on the strength goes in a straight line from what it was to the
//           event's, within `ramp`; without a ramp at once.
// Use       Apply(cycle, set) calls set(index, strength) for every entry whose strength changes in
//           this cycle. An id that several entries have means all of them.
// Thread    one; Apply allocates nothing, throws nothing.
// Failure   the constructor throws std::invalid_argument for an id that no entry has, and for a
//           period that is not positive.

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "common/rig_events.hpp"

namespace levitas::events {

class EffectSchedule {
 public:
  /// `ids` and `strengths` are those of the rig's entries, in order.
  EffectSchedule(const std::vector<ScheduledRigEvent>& events, const std::vector<std::string>& ids,
                 std::vector<double> strengths, double period_s);

  template <class Set>
  void Apply(std::uint64_t cycle, Set set) noexcept {
    for (Change& change : changes_) {
      if (cycle < change.first || change.done) continue;
      double& present = strengths_[change.index];
      if (!change.begun) change.from = present;
      change.begun = true;
      change.done = cycle >= change.first + change.ramp_cycles;
      present = change.to;
      if (!change.done) {
        const double share =
            static_cast<double>(cycle - change.first) / static_cast<double>(change.ramp_cycles);
        present = change.from + share * (change.to - change.from);
      }
      set(change.index, present);
    }
  }

  [[nodiscard]] bool empty() const noexcept { return changes_.empty(); }

 private:
  struct Change {
    std::size_t index{};
    std::uint64_t first{};
    std::uint64_t ramp_cycles{};
    double from{};
    double to{};
    bool begun{};
    bool done{};
  };

  std::vector<Change> changes_;  // in the order of their times
  std::vector<double> strengths_;
};

}  // namespace levitas::events

#pragma once
// Test signals on their way from the network to the loop: made by a thread that may allocate,
// played by the loop, which may not, and given back for the next.
//
// Thread   Put: one thread at a time, not the loop's. Slot::AddTo, GiveBack: loop thread; no
//          allocation, no lock.
// Failure  Put returns nullptr when all kSlots are taken: the loop plays one, others wait in the
//          ring of commands.

#include <array>
#include <atomic>
#include <cstddef>
#include <optional>

#include "controller/cycle/cycle_io.hpp"
#include "controller/loop/operator_source.hpp"
#include "controller/scenario/scenario_player.hpp"

namespace levitas::loop {

class ExcitationPool {
 public:
  static constexpr std::size_t kSlots = 4;

  class Slot {
   public:
    /// Adds this cycle's value; false when there is none any more.
    [[nodiscard]] bool AddTo(cycle::OperatorInput& input, const OperatorView& view) noexcept;
    /// The step's limit of the orbit has reduced what the latest AddTo added.
    [[nodiscard]] bool reduced() const noexcept { return reduced_; }

   private:
    friend class ExcitationPool;
    std::optional<scenario::ScenarioPlayer> player_;
    std::atomic<bool> taken_{false};
    bool reduced_{false};
  };

  /// `step`: one that does nothing but excite.
  [[nodiscard]] Slot* Put(const scenario::Step& step, double period_s);
  static void GiveBack(Slot* slot) noexcept {
    slot->taken_.store(false, std::memory_order_release);
  }

 private:
  std::array<Slot, kSlots> slots_;
};

}  // namespace levitas::loop

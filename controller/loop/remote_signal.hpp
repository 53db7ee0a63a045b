#pragma once
// The test signal of the network between its command and its end.
//
// Table      signal_table.hpp: states, events and edges. This class finds the events and does what
//            the edges say.
// Thread     loop thread; no allocation, lock or exception.
// Not done   limits of all test signals together: scenario/excitation_guard.hpp.

#include "controller/loop/excitation_pool.hpp"
#include "controller/loop/operator_source.hpp"
#include "controller/loop/signal_table.hpp"

namespace levitas::loop {

class RemoteSignal {
 public:
  /// The cycle's command is to excite with `place`; without one it ends what plays.
  void Excite(ExcitationPool::Slot* place) noexcept;
  /// The cycle's command is to end the test signal.
  void End() noexcept;
  /// Once per cycle, after its command was chosen: adds the signal to `input`, or gives it the
  /// command that says the end. `run_ends`: no test signal passes any more. True when the step's
  /// limit of the orbit has reduced what was added.
  [[nodiscard]] bool AddTo(cycle::OperatorInput& input, const OperatorView& view,
                           bool run_ends) noexcept;

  [[nodiscard]] SignalState state() const noexcept { return state_; }

 private:
  /// What is left to do for the caller: to tell the end.
  SignalAction Take(SignalEvent event, ExcitationPool::Slot* place = nullptr) noexcept;

  SignalState state_{SignalState::kNone};
  ExcitationPool::Slot* place_{nullptr};  ///< where the state holds one
};

}  // namespace levitas::loop

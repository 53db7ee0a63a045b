#pragma once
// The command arbiter: decides in each cycle who gives the command.
//
// Order    an emergency stop before everything, in every state, also in a full ring; then the end
//          of the program before a remote command before the scenario. A remote command that its
//          sender gave before a stop is dropped after it: a stop is not undone by what is older.
// The end  a finished or failed scenario, RequestStop and the duration all end in the same way:
//          run down under the drive, land, amplifiers off. A trip under a scenario ends the same
//          way; without a scenario the arbiter waits for a reset. Where the magnets have let go of
//          a turning rotor the arbiter stays, and the supervisor brakes, until the rotor stands or
//          its brake fails. As a table: end_table.hpp; what happens in it: end_of_run.hpp.
// Test signals  a remote one is added to the scenario's. It begins in the cycle after its command,
//          unless that was refused, and ends by its own length, by command, by a new one, with a
//          trip and where the mode does not pass it on; each end is a command of the record. As a
//          table: signal_table.hpp. The guard has the last word on all of them
//          (scenario/excitation_guard.hpp).
// Thread   loop thread, except the requests and the news (any thread, also a signal's) and the
//          writer's side of the ring. No allocation in Next.
// Failure  a landing that is overdue (run_down.hpp) becomes an emergency stop, and is news.
//          Whatever turns levitated after that is held: only a second request ends it.

#include <atomic>
#include <cstdint>
#include <optional>

#include "common/spsc_ring.hpp"
#include "common/stop_latch.hpp"
#include "controller/loop/end_of_run.hpp"
#include "controller/loop/excitation_pool.hpp"
#include "controller/loop/operator_source.hpp"
#include "controller/loop/remote_signal.hpp"
#include "controller/scenario/excitation_guard.hpp"
#include "controller/scenario/scenario_player.hpp"

namespace levitas::loop {

/// A command as it came over the network.
struct RemoteCommand {
  OperatorCommand command{OperatorCommand::kNone};
  double speed_rad_per_s{};
  double acceleration_rad_per_s2{};
  ExcitationPool::Slot* excitation{nullptr};  ///< with kExcite
  CommandOrigin origin{};
  std::uint64_t stops_before{0};  ///< emergency stops of the latch that it came behind
};

/// A remote command that a cycle was given, for those who publish what became of it.
struct GivenCommand {
  std::uint64_t cycle{};
  CommandOrigin origin;
};

/// What the arbiter shares with the threads of the network; each may be null.
struct RemoteCommands {
  SpscRing<RemoteCommand>* commands{nullptr};
  StopLatch* stops{nullptr};
  SpscRing<GivenCommand>* given{nullptr};
};

struct ArbiterOptions {
  double period_s{};
  double stop_acceleration_rad_per_s2{};  ///< of the drive when running down to end
  double standstill_rad_per_s{};          ///< below this the rotor counts as standing
  double landing_ramp_s{};                ///< from the centre to the resting place
  double duration_s{0.0};                 ///< after this long the end begins; 0 = no limit
  scenario::GuardLimits excitation{};     ///< of all test signals together; without axes none
  double trip_window_s{0.5};              ///< a trip's recording needs this much after it
};

class CommandArbiter final : public OperatorSource {
 public:
  /// `player` may be null.
  CommandArbiter(const ArbiterOptions& options, scenario::ScenarioPlayer* player,
                 const RemoteCommands& remote);

  [[nodiscard]] cycle::OperatorInput Next(const OperatorView& view) noexcept override;
  [[nodiscard]] bool Done() const noexcept override { return end_.state() == EndState::kDone; }
  [[nodiscard]] std::int64_t stop_received_ns() const noexcept override {
    return stop_received_ns_;
  }
  /// What was taken from the test signals. Loop thread, or after the loop.
  [[nodiscard]] const scenario::GuardCounts& signals_reduced() const noexcept {
    return guard_.counts();
  }
  /// The next beginning of a reduction, for people. Any one thread beside the loop's.
  bool TakeNotice(scenario::GuardNotice& notice) noexcept { return guard_.TakeNotice(notice); }
  void RequestStop() noexcept { stop_requested_.store(true, std::memory_order_relaxed); }
  /// Given in the next cycle, once; any thread.
  void RequestEmergencyStop() noexcept {
    emergency_requested_.store(true, std::memory_order_relaxed);
  }
  /// The newest frames show a rotor that stands; any thread.
  [[nodiscard]] bool standing() const noexcept { return end_.standing(); }
  /// What has happened at the end so far; any thread.
  [[nodiscard]] EndNews news() const noexcept { return end_.news(); }
  // Loop thread, or after the loop.
  [[nodiscard]] EndState end_state() const noexcept { return end_.state(); }
  [[nodiscard]] SignalState signal_state() const noexcept { return signal_.state(); }

 private:
  [[nodiscard]] cycle::OperatorInput Decide(const OperatorView& view) noexcept;
  [[nodiscard]] bool TakeStop(std::uint64_t cycle) noexcept;
  [[nodiscard]] bool TakeRemote(RemoteCommand& remote) noexcept;
  [[nodiscard]] cycle::OperatorInput Played(const OperatorView& view) noexcept;
  /// With the mark that waits, if this cycle has no command.
  [[nodiscard]] cycle::OperatorInput Marked(cycle::OperatorInput input,
                                            std::uint64_t cycle) noexcept;
  void Serve(const RemoteCommand& remote, std::uint64_t cycle) noexcept;
  /// What there is to end the run for; nothing while it goes on.
  [[nodiscard]] std::optional<EndEvent> WhyEnd(std::uint64_t cycle) const noexcept;

  std::optional<std::uint64_t> duration_cycles_;
  std::optional<std::uint64_t> first_cycle_;
  scenario::ScenarioPlayer* player_;
  RemoteCommands remote_;
  std::optional<RemoteCommand> mark_;
  std::int64_t stop_received_ns_{0};
  std::atomic<bool> stop_requested_{false};
  std::atomic<bool> emergency_requested_{false};
  EndOfRun end_;
  RemoteSignal signal_;
  scenario::ExcitationGuard guard_;
};

}  // namespace levitas::loop

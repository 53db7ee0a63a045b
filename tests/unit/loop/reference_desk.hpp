#pragma once
// The command arbiter as the headers of controller/loop describe it, written again by hand and
// without its tables: what two independent readings agree on is not one slip of the pen.
//
// Borrowed  what has tests of its own: RunDown, ExcitationGuard, the slot of a test signal, the
//           ring and the latch. Not borrowed: who gives the command, how a run ends, when a test
//           signal begins and ends.
// Not said  what happens in cycles after Done: the loop makes none.

#include <cmath>
#include <cstdint>
#include <optional>

#include "controller/loop/command_arbiter.hpp"
#include "controller/supervisor/mode_table.hpp"

namespace levitas::loop::test {

/// The end of the run, once it has begun.
struct EndSoFar {
  std::optional<std::uint64_t> asked;     ///< cycle of the latest request
  std::optional<std::uint64_t> released;  ///< since when no magnet holds the rotor
  bool told_to_brake{};
};

class ReferenceDesk {
 public:
  ReferenceDesk(const ArbiterOptions& options, scenario::ScenarioPlayer* player,
                const RemoteCommands& remote)
      : options_(options),
        player_(player),
        remote_(remote),
        run_down_({options.period_s, options.stop_acceleration_rad_per_s2,
                   options.standstill_rad_per_s, options.landing_ramp_s}),
        guard_(options.excitation) {}

  cycle::OperatorInput Next(const OperatorView& view) {
    if (!first_) first_ = view.cycle;
    run_down_.Look(view.cycle, view.speed_rad_per_s, view.standing);
    cycle::OperatorInput input;
    received_ns_ = 0;
    if (StopAsked(view.cycle)) {
      input.command = OperatorCommand::kEmergencyStop;
    } else if (const auto remote = Remote(); remote && !end_) {
      Serve(*remote, view.cycle, input);
    } else {
      if (remote) GiveBack(remote->excitation);
      if (!end_ && EndWanted(view.cycle)) BeginEnd(view.cycle);
      if (end_) {
        End(view, input);
      } else if (player_ != nullptr) {
        Play(view, input);
      }
      Mark(view.cycle, input);
    }
    Signal(view, input);
    guard_.Limit(view.position_m, input.excitation_a, input.excitation_m);
    return input;
  }

  void RequestStop() { stop_requested_ = true; }
  void RequestEmergencyStop() { emergency_requested_ = true; }
  [[nodiscard]] bool Done() const { return done_; }
  [[nodiscard]] bool standing() const { return run_down_.standing(); }
  [[nodiscard]] EndNews news() const { return news_; }
  [[nodiscard]] std::int64_t stop_received_ns() const { return received_ns_; }
  [[nodiscard]] const scenario::GuardCounts& signals_reduced() const { return guard_.counts(); }

 private:
  [[nodiscard]] std::uint64_t Cycles(double seconds) const {
    return static_cast<std::uint64_t>(std::llround(seconds / options_.period_s));
  }
  static void GiveBack(ExcitationPool::Slot* slot) {
    if (slot != nullptr) ExcitationPool::GiveBack(slot);
  }

  // An emergency stop before everything, in every state. The program's own waits for one of the
  // network that is there in the same cycle.
  bool StopAsked(std::uint64_t cycle) {
    if (remote_.stops == nullptr || !remote_.stops->Take()) {
      const bool asked = emergency_requested_;
      emergency_requested_ = false;
      return asked;
    }
    received_ns_ = remote_.stops->received_ns();
    CommandOrigin origin;
    while (remote_.stops->TakeOrigin(origin)) {
      if (remote_.given != nullptr) remote_.given->Post({cycle, origin});
    }
    return true;
  }

  // A command that its sender gave before a stop is dropped after it.
  std::optional<RemoteCommand> Remote() {
    RemoteCommand command;
    while (!mark_ && remote_.commands != nullptr && remote_.commands->Take(command)) {
      if (remote_.stops == nullptr || command.stops_before >= remote_.stops->taken()) {
        if (command.command != OperatorCommand::kMark) return command;
        mark_ = command;
        break;
      }
      GiveBack(command.excitation);
    }
    return std::nullopt;
  }

  void Serve(const RemoteCommand& remote, std::uint64_t cycle, cycle::OperatorInput& input) {
    if (remote.command == OperatorCommand::kExcite ||
        remote.command == OperatorCommand::kEndExcitation) {
      GiveBack(playing_);
      playing_ = remote.command == OperatorCommand::kExcite ? remote.excitation : nullptr;
      answered_ = false;
      must_say_end_ = false;  // this command says it
    }
    input.command = remote.command;
    input.speed_rad_per_s = remote.speed_rad_per_s;
    input.acceleration_rad_per_s2 = remote.acceleration_rad_per_s2;
    if (remote_.given != nullptr) remote_.given->Post({cycle, remote.origin});
  }

  // In the first cycle that nobody commands anything in, beside what the scenario adds to it.
  void Mark(std::uint64_t cycle, cycle::OperatorInput& input) {
    if (!mark_ || end_ || input.command != OperatorCommand::kNone) return;
    input.command = OperatorCommand::kMark;
    if (remote_.given != nullptr) remote_.given->Post({cycle, mark_->origin});
    mark_.reset();
  }

  [[nodiscard]] bool EndWanted(std::uint64_t cycle) const {
    if (stop_requested_) return true;
    if (player_ != nullptr && player_->outcome() != scenario::Outcome::kPlaying) return true;
    return options_.duration_s > 0.0 && cycle - *first_ >= Cycles(options_.duration_s);
  }

  void BeginEnd(std::uint64_t cycle) {
    end_.emplace();
    run_down_.Begin(cycle);
  }

  void End(const OperatorView& view, cycle::OperatorInput& input) {
    const bool let_go =
        !view.amplifiers_enabled && (view.mode == Mode::kOff || view.mode == Mode::kTripped);
    if (let_go) return AwaitStandstill(view);
    if (end_->released) end_->told_to_brake = false;  // whoever lifted it: to be told anew
    end_->released.reset();
    const bool overdue = run_down_.Overdue(view.cycle);
    if (overdue) Tell(news_.overdue);
    if (view.mode == Mode::kTripped) return;  // the levitated stop brakes and lands by itself
    if (end_->asked && view.cycle - *end_->asked < Cycles(EndOfRun::kRepeatSeconds)) return;
    if (overdue) {
      input.command = OperatorCommand::kEmergencyStop;
    } else if (view.mode == Mode::kLanding) {
      return;
    } else if (view.standing) {
      input.command = OperatorCommand::kLand;
    } else if (view.mode == Mode::kSpinning && end_->told_to_brake) {
      return;
    } else {
      input.command = OperatorCommand::kSpin;
      input.acceleration_rad_per_s2 = options_.stop_acceleration_rad_per_s2;
      end_->told_to_brake = true;
    }
    end_->asked = view.cycle;
  }

  void AwaitStandstill(const OperatorView& view) {
    if (!end_->released) {
      end_->released = view.cycle;
      run_down_.Begin(view.cycle);
    }
    if (run_down_.brake_fails()) Tell(news_.brake_fails);
    const bool recorded =
        view.mode == Mode::kOff || view.cycle - *end_->released >= Cycles(options_.trip_window_s);
    done_ = recorded && (view.standing || run_down_.brake_fails());
  }

  void Tell(bool& news) {
    if (!news) news_.speed_rad_per_s = run_down_.speed_rad_per_s();
    news = true;
  }

  void Play(const OperatorView& view, cycle::OperatorInput& input) {
    const scenario::PlayerOutput played =
        player_->Next(view.mode, view.speed_rad_per_s, view.fault, view.command_refused,
                      view.radius_m, view.standing);
    input = {played.command, played.speed_rad_per_s, played.acceleration_rad_per_s2,
             played.excitation_a, played.excitation_m};
    if (played.gain < 1.0) guard_.NoteOrbitLimit();
  }

  // It begins in the cycle after its command, unless that was refused.
  void Signal(const OperatorView& view, cycle::OperatorInput& input) {
    if (input.command == OperatorCommand::kExcite) return;
    if (playing_ != nullptr) {
      const bool refused = !answered_ && view.command_refused;
      answered_ = true;
      const bool passes = view.mode == Mode::kLevitating || view.mode == Mode::kSpinning ||
                          view.mode == Mode::kCoastDown;
      if (refused || end_ || !passes || !playing_->AddTo(input, view)) {
        GiveBack(playing_);
        playing_ = nullptr;
        must_say_end_ = !refused;
      } else if (playing_->reduced()) {
        guard_.NoteOrbitLimit();
      }
    }
    if (must_say_end_ && input.command == OperatorCommand::kNone) {
      input.command = OperatorCommand::kEndExcitation;
      must_say_end_ = false;
    }
  }

  ArbiterOptions options_;
  scenario::ScenarioPlayer* player_;
  RemoteCommands remote_;
  RunDown run_down_;
  scenario::ExcitationGuard guard_;
  std::optional<std::uint64_t> first_;
  std::optional<EndSoFar> end_;
  std::optional<RemoteCommand> mark_;
  ExcitationPool::Slot* playing_{nullptr};
  bool answered_{false};
  bool must_say_end_{false};
  bool stop_requested_{false};
  bool emergency_requested_{false};
  bool done_{false};
  EndNews news_{};
  std::int64_t received_ns_{0};
};

}  // namespace levitas::loop::test

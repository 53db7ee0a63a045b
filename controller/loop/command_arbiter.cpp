#include "controller/loop/command_arbiter.hpp"

#include <cmath>

#include "controller/supervisor/mode_table.hpp"

namespace levitas::loop {

CommandArbiter::CommandArbiter(const DeskOptions& options, scenario::ScenarioPlayer* player,
                               const RemoteDesk& remote)
    : options_(options),
      player_(player),
      remote_(remote),
      run_down_({.period_s = options.period_s,
                 .deceleration_rad_per_s2 = options.stop_acceleration_rad_per_s2,
                 .standstill_rad_per_s = options.standstill_rad_per_s,
                 .landing_ramp_s = options.landing_ramp_s}),
      guard_(options.excitation) {}

std::uint64_t CommandArbiter::Cycles(double seconds) const noexcept {
  return static_cast<std::uint64_t>(std::llround(seconds / options_.period_s));
}

bool CommandArbiter::Ending(const OperatorView& view) noexcept {
  if (ending_) return true;
  const bool over =
      options_.duration_s > 0.0 && view.cycle - first_cycle_ >= Cycles(options_.duration_s);
  const bool played = player_ != nullptr && player_->outcome() != scenario::Outcome::kPlaying;
  ending_ = over || played || stop_requested_.load(std::memory_order_relaxed);
  if (!ending_) return false;
  run_down_.Begin(view.cycle);
  last_request_ = view.cycle - Cycles(kRepeatSeconds);  // the first request is made at once
  return ending_;
}

void CommandArbiter::Tell(std::atomic<bool>& news) noexcept {
  if (news.load(std::memory_order_relaxed)) return;
  news_speed_rad_per_s_.store(run_down_.speed_rad_per_s(), std::memory_order_relaxed);
  news.store(true, std::memory_order_relaxed);
}

// The magnets have let go; the supervisor brakes for as long as this goes on.
void CommandArbiter::AwaitStandstill(const OperatorView& view) noexcept {
  if (!safe_) {
    safe_since_ = view.cycle;
    run_down_.Begin(view.cycle);
  }
  safe_ = true;
  const bool recorded =
      view.mode == Mode::kOff || view.cycle - safe_since_ >= Cycles(options_.trip_window_s);
  if (run_down_.brake_fails()) Tell(brake_fails_);
  done_ = recorded && (run_down_.standing() || run_down_.brake_fails());
}

cycle::OperatorInput CommandArbiter::Stop(const OperatorView& view) noexcept {
  cycle::OperatorInput input;
  const bool at_rest = view.mode == Mode::kOff || view.mode == Mode::kTripped;
  if (at_rest && !view.amplifiers_enabled) {
    AwaitStandstill(view);
    return input;
  }
  safe_ = false;
  const bool turns = !run_down_.standing();
  const bool under_way = view.mode == Mode::kTripped || view.mode == Mode::kLanding ||
                         (braking_ && view.mode == Mode::kSpinning && turns);
  const bool overdue = run_down_.Overdue(view.cycle);
  if (overdue) Tell(overdue_);
  if (under_way && (!overdue || view.mode == Mode::kTripped)) return input;
  if (view.cycle - last_request_ < Cycles(kRepeatSeconds)) return input;
  last_request_ = view.cycle;
  if (overdue) {
    input.command = OperatorCommand::kEmergencyStop;
  } else if (turns) {
    braking_ = true;
    input.command = OperatorCommand::kSpin;
    input.acceleration_rad_per_s2 = options_.stop_acceleration_rad_per_s2;
  } else {
    input.command = OperatorCommand::kLand;
  }
  return input;
}

void CommandArbiter::DropExcitation() noexcept {
  if (playing_ != nullptr) ExcitationPool::GiveBack(playing_);
  playing_ = nullptr;
  awaits_answer_ = false;
}

void CommandArbiter::Begin(const RemoteCommand& remote) noexcept {
  if (remote.command == OperatorCommand::kExcite) {
    DropExcitation();
    playing_ = remote.excitation;
    awaits_answer_ = true;
    end_untold_ = false;
  } else if (remote.command == OperatorCommand::kEndExcitation) {
    DropExcitation();
    end_untold_ = false;
  }
}

void CommandArbiter::Excite(const OperatorView& view, cycle::OperatorInput& input) noexcept {
  if (playing_ != nullptr && input.command != OperatorCommand::kExcite) {
    const bool refused = awaits_answer_ && view.command_refused;
    awaits_answer_ = false;
    if (refused) {
      DropExcitation();
    } else if (ending_ || !supervisor::PassesExcitation(view.mode) ||
               !playing_->AddTo(input, view)) {
      DropExcitation();
      end_untold_ = true;
    } else if (playing_->reduced()) {
      guard_.NoteOrbitLimit();
    }
  }
  if (end_untold_ && input.command == OperatorCommand::kNone) {
    input.command = OperatorCommand::kEndExcitation;
    end_untold_ = false;
  }
}

cycle::OperatorInput CommandArbiter::Next(const OperatorView& view) noexcept {
  run_down_.Look(view.cycle, view.speed_rad_per_s, view.standing);
  stands_.store(run_down_.standing(), std::memory_order_relaxed);
  cycle::OperatorInput input = Decide(view);
  Excite(view, input);
  guard_.Limit(view.position_m, input.excitation_a, input.excitation_m);
  return input;
}

// All that are there at once: one trip answers them all.
bool CommandArbiter::TakeStop(std::uint64_t cycle) noexcept {
  stop_received_ns_ = 0;
  const bool asked = remote_.stops != nullptr && remote_.stops->Take();
  if (!asked) {
    return emergency_requested_.load(std::memory_order_relaxed) &&
           emergency_requested_.exchange(false, std::memory_order_relaxed);
  }
  stop_received_ns_ = remote_.stops->received_ns();
  CommandOrigin origin;
  for (std::size_t i = 0; i < StopLatch::kOrigins && remote_.stops->TakeOrigin(origin); ++i) {
    if (remote_.given != nullptr) remote_.given->Post({cycle, origin});
  }
  return true;
}

// The next one that is not older than a stop: at most as many as the ring holds.
bool CommandArbiter::TakeRemote(RemoteCommand& remote) noexcept {
  if (remote_.commands == nullptr) return false;
  const std::uint64_t stopped = remote_.stops != nullptr ? remote_.stops->taken() : 0;
  for (std::size_t i = 0; i < remote_.commands->capacity(); ++i) {
    if (!remote_.commands->Take(remote)) return false;
    if (remote.stops_before >= stopped) return true;
    if (remote.excitation != nullptr) ExcitationPool::GiveBack(remote.excitation);
  }
  return false;
}

cycle::OperatorInput CommandArbiter::Decide(const OperatorView& view) noexcept {
  if (!started_) {
    started_ = true;
    first_cycle_ = view.cycle;
  }
  if (TakeStop(view.cycle)) return {.command = OperatorCommand::kEmergencyStop};
  RemoteCommand remote;
  const bool commanded = TakeRemote(remote);
  if (commanded && !ending_) {
    Begin(remote);
    if (remote_.given != nullptr) remote_.given->Post({view.cycle, remote.origin});
    return {.command = remote.command,
            .speed_rad_per_s = remote.speed_rad_per_s,
            .acceleration_rad_per_s2 = remote.acceleration_rad_per_s2};
  }
  if (commanded && remote.excitation != nullptr) ExcitationPool::GiveBack(remote.excitation);
  return Ending(view) ? Stop(view) : Played(view);
}

cycle::OperatorInput CommandArbiter::Played(const OperatorView& view) noexcept {
  cycle::OperatorInput input;
  if (player_ == nullptr) return input;
  const auto played = player_->Next(view.mode, view.speed_rad_per_s, view.fault,
                                    view.command_refused, view.radius_m, view.standing);
  input.command = played.command;
  input.speed_rad_per_s = played.speed_rad_per_s;
  input.acceleration_rad_per_s2 = played.acceleration_rad_per_s2;
  input.excitation_a = played.excitation_a;
  input.excitation_m = played.excitation_m;
  if (played.gain < scenario::OrbitLimiter::kWhole) guard_.NoteOrbitLimit();
  return input;
}

}  // namespace levitas::loop

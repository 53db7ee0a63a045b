#include "controller/loop/command_arbiter.hpp"

#include <cmath>

#include "controller/supervisor/mode_table.hpp"

namespace levitas::loop {

CommandArbiter::CommandArbiter(const DeskOptions& options, scenario::ScenarioPlayer* player,
                               const RemoteDesk& remote)
    : options_(options), player_(player), remote_(remote) {}

std::uint64_t CommandArbiter::Cycles(double seconds) const noexcept {
  return static_cast<std::uint64_t>(std::llround(seconds / options_.period_s));
}

bool CommandArbiter::Ending(const OperatorView& view) noexcept {
  if (ending_) return true;
  const bool over =
      options_.duration_s > 0.0 && view.cycle - first_cycle_ >= Cycles(options_.duration_s);
  const bool played = player_ != nullptr && player_->outcome() != scenario::Outcome::kPlaying;
  ending_ = over || played || stop_requested_.load(std::memory_order_relaxed);
  end_start_ = view.cycle;
  last_request_ = view.cycle - Cycles(kRepeatSeconds);  // the first request is made at once
  return ending_;
}

cycle::OperatorInput CommandArbiter::Stop(const OperatorView& view) noexcept {
  cycle::OperatorInput input;
  const bool at_rest = view.mode == Mode::kOff || view.mode == Mode::kTripped;
  if (at_rest && !view.amplifiers_enabled) {
    if (!safe_) safe_since_ = view.cycle;
    safe_ = true;
    done_ = view.mode == Mode::kOff || view.cycle - safe_since_ >= Cycles(options_.trip_window_s);
    return input;
  }
  safe_ = false;
  const bool under_way = view.mode == Mode::kTripped || view.mode == Mode::kLanding ||
                         (braking_ && view.mode == Mode::kSpinning &&
                          std::abs(view.speed_rad_per_s) > options_.standstill_rad_per_s);
  const bool overdue = view.cycle - end_start_ > Cycles(kStopLimitSeconds);
  if (under_way && !overdue) return input;
  if (view.cycle - last_request_ < Cycles(kRepeatSeconds)) return input;
  last_request_ = view.cycle;
  if (overdue) {
    input.command = OperatorCommand::kEmergencyStop;
  } else if (std::abs(view.speed_rad_per_s) > options_.standstill_rad_per_s) {
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
    }
  }
  if (end_untold_ && input.command == OperatorCommand::kNone) {
    input.command = OperatorCommand::kEndExcitation;
    end_untold_ = false;
  }
}

cycle::OperatorInput CommandArbiter::Next(const OperatorView& view) noexcept {
  cycle::OperatorInput input = Decide(view);
  Excite(view, input);
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
                                    view.command_refused, view.radius_m);
  input.command = played.command;
  input.speed_rad_per_s = played.speed_rad_per_s;
  input.acceleration_rad_per_s2 = played.acceleration_rad_per_s2;
  input.excitation_a = played.excitation_a;
  input.excitation_m = played.excitation_m;
  return input;
}

}  // namespace levitas::loop

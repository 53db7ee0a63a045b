#include "controller/loop/command_arbiter.hpp"

#include <cmath>

namespace levitas::loop {

CommandArbiter::CommandArbiter(const ArbiterOptions& options, scenario::ScenarioPlayer* player,
                               const RemoteCommands& remote)
    : duration_cycles_(options.duration_s > 0.0
                           ? std::optional(static_cast<std::uint64_t>(
                                 std::llround(options.duration_s / options.period_s)))
                           : std::nullopt),
      player_(player),
      remote_(remote),
      end_({.period_s = options.period_s,
            .deceleration_rad_per_s2 = options.stop_acceleration_rad_per_s2,
            .standstill_rad_per_s = options.standstill_rad_per_s,
            .landing_ramp_s = options.landing_ramp_s},
           options.trip_window_s),
      guard_(options.excitation) {}

cycle::OperatorInput CommandArbiter::Next(const OperatorView& view) noexcept {
  end_.Look(view);
  cycle::OperatorInput input = Decide(view);
  if (signal_.AddTo(input, view, !end_.serves())) guard_.NoteOrbitLimit();
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

void CommandArbiter::Serve(const RemoteCommand& remote, std::uint64_t cycle) noexcept {
  if (remote.command == OperatorCommand::kExcite) signal_.Excite(remote.excitation);
  if (remote.command == OperatorCommand::kEndExcitation) signal_.End();
  if (remote_.given != nullptr) remote_.given->Post({cycle, remote.origin});
}

cycle::OperatorInput CommandArbiter::Decide(const OperatorView& view) noexcept {
  if (!first_cycle_) first_cycle_ = view.cycle;
  if (TakeStop(view.cycle)) return {.command = OperatorCommand::kEmergencyStop};
  RemoteCommand remote;
  const bool commanded = !mark_ && TakeRemote(remote);
  if (commanded && remote.command == OperatorCommand::kMark) {
    mark_ = remote;
  } else if (commanded && end_.serves()) {
    Serve(remote, view.cycle);
    return {.command = remote.command,
            .speed_rad_per_s = remote.speed_rad_per_s,
            .acceleration_rad_per_s2 = remote.acceleration_rad_per_s2};
  }
  if (commanded && remote.excitation != nullptr) ExcitationPool::GiveBack(remote.excitation);
  if (const auto why = WhyEnd(view.cycle)) end_.Begin(*why, view);
  return end_.serves() ? Marked(Played(view), view.cycle) : end_.Next(view);
}

// A command has its cycle to itself; a mark is no command to the rig, and takes nothing away from
// the scenario and its test signal: it waits for a cycle without a command.
cycle::OperatorInput CommandArbiter::Marked(cycle::OperatorInput input,
                                            std::uint64_t cycle) noexcept {
  if (!mark_ || input.command != OperatorCommand::kNone) return input;
  Serve(*mark_, cycle);
  mark_.reset();
  input.command = OperatorCommand::kMark;
  return input;
}

std::optional<EndEvent> CommandArbiter::WhyEnd(std::uint64_t cycle) const noexcept {
  if (player_ != nullptr && player_->outcome() != scenario::Outcome::kPlaying) {
    return EndEvent::kScenarioOver;
  }
  if (duration_cycles_ && cycle - *first_cycle_ >= *duration_cycles_)
    return EndEvent::kDurationOver;
  if (stop_requested_.load(std::memory_order_relaxed)) return EndEvent::kStopRequested;
  return std::nullopt;
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

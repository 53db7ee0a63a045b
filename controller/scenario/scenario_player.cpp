#include "controller/scenario/scenario_player.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "common/rotational_speed.hpp"

namespace levitas::scenario {
namespace {

std::uint64_t Cycles(double time_s, double period_s) {
  return static_cast<std::uint64_t>(std::llround(std::max(time_s, 0.0) / period_s));
}

}  // namespace

std::string_view Name(Outcome outcome) noexcept {
  constexpr std::array<std::string_view, 5> kNames{"playing", "finished", "refused", "timed_out",
                                                   "tripped"};
  const auto index = static_cast<std::size_t>(outcome);
  return index < kNames.size() ? kNames[index] : "invalid";
}

ScenarioPlayer::ScenarioPlayer(ScenarioConfig config, double period_s, double standstill_rad_per_s)
    : config_(std::move(config)),
      standstill_rad_per_s_(standstill_rad_per_s),
      limiter_(period_s),
      outcome_(config_.steps.empty() ? Outcome::kFinished : Outcome::kPlaying) {
  if (!(period_s > 0.0))
    throw std::invalid_argument("scenario player: the period must be positive");
  for (const Step& step : config_.steps) {
    timing_.push_back({Cycles(step.timeout_s, period_s), Cycles(step.hold_s, period_s)});
    std::vector<Source>& sources = sources_.emplace_back();
    for (const Excitation& e : step.excitation) {
      if (e.axis >= kMaxAxes) throw std::invalid_argument("scenario player: no such axis");
      const bool current = e.point == Injection::kControlCurrent;
      sources.push_back(
          {Signal(e, period_s), e.axis, e.point, current ? e.amplitude_a : e.amplitude_m});
    }
  }
}

bool ScenarioPlayer::Reached(const Step& step, Mode mode, double speed_rad_per_s,
                             bool standing) const noexcept {
  switch (step.wait) {
    case Wait::kNothing:
      return true;
    case Wait::kMode:
      return mode == step.wait_mode;
    case Wait::kSpeedReached:
      return (standing || step.speed_rad_per_s != 0.0) &&
             std::abs(speed_rad_per_s - step.speed_rad_per_s) <=
                 std::max(standstill_rad_per_s_, kSpeedTolerance * std::abs(step.speed_rad_per_s));
    case Wait::kStandstill:
      return standing && std::abs(speed_rad_per_s) < standstill_rad_per_s_;
  }
  return false;
}

bool ScenarioPlayer::Ended(Fault fault, bool refused) noexcept {
  if (fault != Fault::kNone && !trip_expected_) {
    fault_ = fault;
    outcome_ = Outcome::kTripped;
  } else if (phase_ == Phase::kWait && cycles_in_phase_ == 0 && refused) {
    outcome_ = Outcome::kRefused;
  }
  return outcome_ != Outcome::kPlaying;
}

PlayerOutput ScenarioPlayer::Next(Mode mode, double speed_rad_per_s, Fault fault, bool refused,
                                  double radius_m, bool standing) noexcept {
  PlayerOutput output;
  last_mode_ = mode;
  last_speed_rad_per_s_ = speed_rad_per_s;
  if (outcome_ != Outcome::kPlaying || Ended(fault, refused)) return output;
  // An expected trip has passed once the reset that was asked for has taken effect.
  if (fault == Fault::kNone && phase_ != Phase::kCommand &&
      config_.steps[step_].command == OperatorCommand::kReset) {
    trip_expected_ = false;
  }
  if (phase_ == Phase::kWait) {
    if (Reached(config_.steps[step_], mode, speed_rad_per_s, standing)) {
      phase_ = Phase::kHold;
      cycles_in_phase_ = 0;
    } else if (++cycles_in_phase_ > timing_[step_].timeout_cycles) {
      outcome_ = Outcome::kTimedOut;
      return output;
    }
  }
  if (phase_ == Phase::kHold) {
    if (cycles_in_phase_ < timing_[step_].hold_cycles) {
      Excite(output, radius_m);
      ++cycles_in_phase_;
      return output;
    }
    if (step_ + 1 == config_.steps.size()) {
      outcome_ = Outcome::kFinished;
      return output;
    }
    ++step_;
    phase_ = Phase::kCommand;
  }
  if (phase_ == Phase::kCommand) Give(output);
  return output;
}

void ScenarioPlayer::Give(PlayerOutput& output) noexcept {
  const Step& step = config_.steps[step_];
  output.command = step.command;
  output.speed_rad_per_s = step.speed_rad_per_s;
  output.acceleration_rad_per_s2 = step.acceleration_rad_per_s2;
  const bool asks_for_a_trip = step.command == OperatorCommand::kEmergencyStop ||
                               (step.wait == Wait::kMode && step.wait_mode == Mode::kTripped);
  trip_expected_ = trip_expected_ || asks_for_a_trip;
  phase_ = Phase::kWait;
  cycles_in_phase_ = 0;
}

void ScenarioPlayer::Excite(PlayerOutput& output, double radius_m) noexcept {
  if (sources_[step_].empty()) return;
  if (cycles_in_phase_ == 0) limiter_.Reset();
  const double gain = limiter_.Next(radius_m, config_.steps[step_].orbit_limit_m);
  output.gain = gain;
  for (Source& source : sources_[step_]) {
    const double value = gain * (source.amplitude * source.signal.Next());
    (source.point == Injection::kControlCurrent ? output.excitation_a
                                                : output.excitation_m)[source.axis] += value;
  }
}

std::string ScenarioPlayer::Why() const {
  const Step& step = config_.steps[step_];
  switch (outcome_) {
    case Outcome::kRefused:
      return fmt::format("the controller refused the command in mode {}", Name(last_mode_));
    case Outcome::kTripped:
      return fmt::format("the controller tripped: {}", Name(fault_));
    case Outcome::kTimedOut:
      break;
    case Outcome::kPlaying:
    case Outcome::kFinished:
      return {};
  }
  const double speed_rpm = RadPerSToRpm(last_speed_rad_per_s_);
  switch (step.wait) {
    case Wait::kMode:
      return fmt::format("mode {} was not reached within {} s; mode is {}", Name(step.wait_mode),
                         step.timeout_s, Name(last_mode_));
    case Wait::kSpeedReached:
      return fmt::format("{:.0f} rpm was not reached within {} s; speed is {:.0f} rpm",
                         RadPerSToRpm(step.speed_rad_per_s), step.timeout_s, speed_rpm);
    case Wait::kStandstill:
    case Wait::kNothing:
      break;
  }
  return fmt::format("the rotor did not stand still within {} s; speed is {:.1f} rpm",
                     step.timeout_s, speed_rpm);
}

std::string ScenarioPlayer::Text() const {
  if (!failed()) return {};
  return fmt::format("scenario {}, step {} of {} ({}): {}", config_.name, step_ + 1,
                     config_.steps.size(), Name(config_.steps[step_].command), Why());
}

}  // namespace levitas::scenario

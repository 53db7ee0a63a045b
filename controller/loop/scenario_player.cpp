#include "controller/loop/scenario_player.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace levitas::loop {

namespace {
// A drive holds its set point to about a part in a thousand; ten times that counts as reached.
constexpr double kSpeedTolerance = 0.01;
}  // namespace

ScenarioPlayer::ScenarioPlayer(scenario::ScenarioConfig config, double period_s,
                               double standstill_rad_per_s)
    : config_(std::move(config)),
      period_s_(period_s),
      standstill_rad_per_s_(standstill_rad_per_s),
      outcome_(config_.steps.empty() ? Outcome::kFinished : Outcome::kPlaying) {}

std::uint64_t ScenarioPlayer::Cycles(double seconds) const noexcept {
  return static_cast<std::uint64_t>(std::llround(seconds / period_s_));
}

bool ScenarioPlayer::Reached(const scenario::Step& step, const OperatorView& view) const noexcept {
  switch (step.wait) {
    case scenario::Wait::kNothing:
      return true;
    case scenario::Wait::kMode:
      return view.mode == step.wait_mode;
    case scenario::Wait::kSpeedReached:
      return std::abs(view.speed_rad_per_s - step.speed_rad_per_s) <=
             std::max(standstill_rad_per_s_, kSpeedTolerance * std::abs(step.speed_rad_per_s));
    case scenario::Wait::kStandstill:
      return std::abs(view.speed_rad_per_s) <= standstill_rad_per_s_;
  }
  return false;
}

void ScenarioPlayer::Advance(const scenario::Step& step, const OperatorView& view) noexcept {
  if (phase_ == Phase::kWait) {
    if (Reached(step, view)) {
      phase_ = Phase::kHold;
      phase_start_ = view.cycle;
    } else if (view.cycle - phase_start_ > Cycles(step.timeout_s)) {
      outcome_ = Outcome::kTimedOut;
    }
  }
  if (phase_ == Phase::kHold && view.cycle - phase_start_ >= Cycles(step.hold_s)) {
    phase_ = Phase::kCommand;
    if (++step_ == config_.steps.size()) outcome_ = Outcome::kFinished;
  }
}

cycle::OperatorInput ScenarioPlayer::Next(const OperatorView& view) noexcept {
  if (outcome_ != Outcome::kPlaying) return {};
  if (view.fault != Fault::kNone) {
    outcome_ = Outcome::kTripped;
    return {};
  }
  if (phase_ != Phase::kCommand) {
    const bool answered = view.cycle == phase_start_ + 1 && phase_ == Phase::kWait;
    if (answered && view.command_refused) {
      outcome_ = Outcome::kRefused;
      return {};
    }
    Advance(config_.steps[step_], view);
    if (phase_ != Phase::kCommand || outcome_ != Outcome::kPlaying) return {};
  }
  const scenario::Step& step = config_.steps[step_];
  phase_ = Phase::kWait;
  phase_start_ = view.cycle;
  cycle::OperatorInput input;
  input.command = step.command;
  input.speed_rad_per_s = step.speed_rad_per_s;
  input.acceleration_rad_per_s2 = step.acceleration_rad_per_s2;
  return input;
}

std::string ScenarioPlayer::Text() const {
  const auto where = [this](const char* what) {
    const std::size_t at = std::min(step_, config_.steps.size() - 1);
    return fmt::format("scenario \"{}\", step {} of {} ({}): {}", config_.name, at + 1,
                       config_.steps.size(), Name(config_.steps[at].command), what);
  };
  switch (outcome_) {
    case Outcome::kRefused:
      return where("the controller refused the command in its present mode");
    case Outcome::kTimedOut:
      return where(fmt::format("not reached within {} s", config_.steps[step_].timeout_s).c_str());
    case Outcome::kTripped:
      return where("the controller tripped");
    case Outcome::kPlaying:
    case Outcome::kFinished:
      break;
  }
  return {};
}

}  // namespace levitas::loop

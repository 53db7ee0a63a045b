#include "controller/loop/end_of_run.hpp"

#include <cmath>

namespace levitas::loop {

namespace {

std::uint64_t Cycles(double seconds, double period_s) noexcept {
  return static_cast<std::uint64_t>(std::llround(seconds / period_s));
}

EndEvent OfMagnets(const OperatorView& view) noexcept {
  const bool at_rest = view.mode == Mode::kOff || view.mode == Mode::kTripped;
  return at_rest && !view.amplifiers_enabled ? EndEvent::kReleased : EndEvent::kHeld;
}

}  // namespace

EndOfRun::EndOfRun(const RunDownLimits& limits, double trip_window_s) noexcept
    : run_down_(limits),
      acceleration_rad_per_s2_(limits.deceleration_rad_per_s2),
      repeat_cycles_(Cycles(kRepeatSeconds, limits.period_s)),
      trip_window_cycles_(Cycles(trip_window_s, limits.period_s)) {}

void EndOfRun::Look(const OperatorView& view) noexcept {
  run_down_.Look(view.cycle, view.speed_rad_per_s, view.standing);
  stands_.store(run_down_.standing(), std::memory_order_relaxed);
}

void EndOfRun::Begin(EndEvent why, const OperatorView& view) noexcept {
  cycle::OperatorInput none;
  Take(why, view, none);
}

cycle::OperatorInput EndOfRun::Next(const OperatorView& view) noexcept {
  cycle::OperatorInput input;
  const EndEvent magnets = OfMagnets(view);
  Take(magnets, view, input);
  Watch(view);
  if (magnets == EndEvent::kHeld) {
    Take(OfHeldRotor(view), view, input);
  } else if (run_down_.standing()) {
    Take(EndEvent::kStands, view, input);
  } else if (run_down_.brake_fails()) {
    Take(EndEvent::kBrakeFails, view, input);
  }
  return input;
}

EndEvent EndOfRun::OfHeldRotor(const OperatorView& view) const noexcept {
  if (view.mode == Mode::kTripped) return EndEvent::kStops;
  if (run_down_.Overdue(view.cycle)) return EndEvent::kOverdue;
  if (view.mode == Mode::kLanding) return EndEvent::kLands;
  if (run_down_.standing()) return EndEvent::kStands;
  return view.mode == Mode::kSpinning ? EndEvent::kSpins : EndEvent::kTurns;
}

void EndOfRun::Take(EndEvent event, const OperatorView& view,
                    cycle::OperatorInput& input) noexcept {
  const EndStep step = Advance(state_, event, Guards(view));
  state_ = step.to;
  Act(step.action, view.cycle, input);
}

EndGuards EndOfRun::Guards(const OperatorView& view) const noexcept {
  return {.request_due = view.cycle - requested_ >= repeat_cycles_,
          .recorded = view.mode == Mode::kOff || view.cycle - released_ >= trip_window_cycles_};
}

void EndOfRun::Act(EndAction action, std::uint64_t cycle, cycle::OperatorInput& input) noexcept {
  switch (action) {
    case EndAction::kNone:
      return;
    case EndAction::kBegin:
      run_down_.Begin(cycle);
      requested_ = cycle - repeat_cycles_;
      return;
    case EndAction::kTimeRelease:
      run_down_.Begin(cycle);
      released_ = cycle;
      return;
    case EndAction::kAskBrake:
      input.command = OperatorCommand::kSpin;
      input.acceleration_rad_per_s2 = acceleration_rad_per_s2_;
      break;
    case EndAction::kAskLanding:
      input.command = OperatorCommand::kLand;
      break;
    case EndAction::kAskStop:
      input.command = OperatorCommand::kEmergencyStop;
      break;
  }
  requested_ = cycle;
}

void EndOfRun::Watch(const OperatorView& view) noexcept {
  switch (Row(state_).watch) {
    case EndWatch::kNothing:
      return;
    case EndWatch::kLanding:
      if (run_down_.Overdue(view.cycle)) Tell(overdue_);
      return;
    case EndWatch::kBrake:
      if (run_down_.brake_fails()) Tell(brake_fails_);
      return;
  }
}

void EndOfRun::Tell(std::atomic<bool>& news) noexcept {
  if (news.load(std::memory_order_relaxed)) return;
  news_speed_rad_per_s_.store(run_down_.speed_rad_per_s(), std::memory_order_relaxed);
  news.store(true, std::memory_order_relaxed);
}

EndNews EndOfRun::news() const noexcept {
  return {overdue_.load(std::memory_order_relaxed), brake_fails_.load(std::memory_order_relaxed),
          news_speed_rad_per_s_.load(std::memory_order_relaxed)};
}

}  // namespace levitas::loop

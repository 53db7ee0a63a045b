#include "benchmark/lives/signal_plan.hpp"

#include <algorithm>

#include "benchmark/lives/ranges.hpp"
#include "common/rotational_speed.hpp"

namespace levitas::lives {

scenario::Excitation DrawSignal(Random& random, const RigNumbers& rig) {
  const Ranges draw(random);
  scenario::Excitation e;
  e.axis = draw.One(rig.axes());
  e.channel = rig.channels[e.axis];
  e.kind = static_cast<scenario::SignalKind>(draw.One(6));
  e.point = draw.One(3) == 0 ? scenario::Injection::kMeasuredPosition
                             : scenario::Injection::kControlCurrent;
  e.amplitude_a = std::min(rig.bias_current_a, rig.max_coil_current_a - rig.bias_current_a) *
                  (draw.Coin() ? 1.0 : draw.Between(0.01, 1.0));
  e.amplitude_m = rig.clearance_m * draw.Between(0.01, 0.99);
  e.order = 5 + static_cast<int>(draw.One(10));
  e.divisor = static_cast<std::uint32_t>(draw.Over(1.0, 300.0));
  e.seed = random.Bits() % 1000;
  e.from_hz = draw.Over(2.0, 500.0);
  e.to_hz = std::min(e.from_hz * draw.Over(1.0, 50.0), 0.45 / rig.period_s());
  e.frequencies = 1 + static_cast<std::uint32_t>(draw.One(20));
  e.dwell_s = draw.Over(0.02, 0.5);
  e.repeat_s = draw.Over(0.05, 1.0);
  e.width_s = draw.Over(1e-4, 3e-2);
  return e;
}

namespace {

scenario::Step DrawStep(Random& random, const RigNumbers& rig) {
  const Ranges draw(random);
  scenario::Step step;
  step.hold_s = 1.5;
  step.orbit_limit_m = rig.clearance_m * (draw.Coin() ? 0.3 : draw.Between(0.1, 0.99));
  // All axes alike in half of the lives: that is what drives a rotor farthest.
  if (draw.Coin()) {
    const scenario::Excitation same = DrawSignal(random, rig);
    for (std::size_t axis = 0; axis < rig.axes(); ++axis) {
      step.excitation.push_back(same);
      step.excitation.back().axis = axis;
      step.excitation.back().channel = rig.channels[axis];
    }
    return step;
  }
  const std::size_t signals = 1 + draw.One(8);
  for (std::size_t n = 0; n < signals; ++n) step.excitation.push_back(DrawSignal(random, rig));
  return step;
}

}  // namespace

LifePlan DrawSignals(std::uint64_t seed, double speed_rpm, const RigNumbers& rig) {
  LifePlan plan;
  plan.seed = seed;
  plan.kinds = {Kind::kTestSignals};
  // The drive's own run-up: a speed that leaps is unknown to the supervisor, and rightly so.
  const double rate = RadPerSToRpm(rig.max_acceleration_rad_per_s2);
  const double run_up_s = speed_rpm / rate;
  plan.length_ns = Ns(3.5 + run_up_s);
  plan.watchdog_periods = 1000;
  Random random(seed);
  const std::size_t way = Ranges(random).One(3);  // a scenario, a request, or both at once
  plan.plays_scenario = way != 1;
  plan.scenario.name = "signals";
  scenario::Step wait;
  wait.hold_s = 5.0;
  plan.scenario.steps = {LiftStep(), wait};
  if (way != 1) {
    scenario::Step rest;
    rest.hold_s = 0.4 + run_up_s;
    plan.scenario.steps.insert(plan.scenario.steps.end() - 1, {rest, DrawStep(random, rig)});
  } else {
    plan.actions.push_back(
        {.at_ns = Ns(0.0), .deed = Deed::kCommand, .command = OperatorCommand::kLift});
  }
  if (speed_rpm > 0.0) {
    plan.actions.push_back({.at_ns = Ns(kLiftedS),
                            .deed = Deed::kCommand,
                            .command = OperatorCommand::kSpin,
                            .speed_rpm = speed_rpm,
                            .rpm_per_s = rate});
  }
  if (way != 0) {
    plan.signals.push_back(DrawStep(random, rig));
    plan.actions.push_back({.at_ns = Ns(1.7 + run_up_s), .deed = Deed::kExcite});
  }
  return plan;
}

}  // namespace levitas::lives

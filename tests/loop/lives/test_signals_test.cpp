// No test signal, of whatever kind and by whatever way, drives the rotor into its touchdown
// bearings: the harm without the guard, none with it, on the nonlinear plant under the real loop.

#include <gtest/gtest.h>

#include <string>

#include "benchmark/lives/life.hpp"
#include "benchmark/lives/signal_plan.hpp"
#include "common/rotational_speed.hpp"

namespace levitas::lives {
namespace {

struct Pairing {
  const char* rig;
  const char* controller;
};

class TestSignals : public testing::TestWithParam<Pairing> {
 protected:
  static constexpr std::uint64_t kFirst = 20261124;
  static constexpr std::uint64_t kDraws = 2;

  struct Sum {
    std::uint64_t touched{};
    std::uint64_t excited{};
    std::string which;
  };

  /// Standing, at half and at full speed (3000 and 6000 rpm of the flexible rotor).
  static Sum Draw(bool guarded) {
    const LifeRig rig = LoadLifeRig(GetParam().rig, GetParam().controller);
    Sum sum;
    for (std::uint64_t n = 0; n < kDraws; ++n) {
      for (const double share : {0.0, 0.5, 1.0}) {
        const double rpm = share * RadPerSToRpm(rig.config.rig.max_speed_rad_per_s);
        LifePlan plan = DrawSignals(kFirst + n, rpm, rig.config.rig);
        plan.guards_signals = guarded;
        const LifeResult life = RunLife(rig, plan);
        if (life.most_excitation_a > 0.0 || life.most_excitation_m > 0.0) ++sum.excited;
        if (life.excited_contacts == 0) continue;
        ++sum.touched;
        sum.which += " seed " + std::to_string(plan.seed) + " at " + std::to_string(rpm) + " rpm;";
      }
    }
    return sum;
  }
};

TEST_P(TestSignals, OfAnyKindAndWayDriveNoRotorIntoItsBearings) {
  const Sum sum = Draw(true);
  EXPECT_EQ(sum.touched, 0U) << sum.which;
  EXPECT_EQ(sum.excited, 3 * kDraws);  // and the rotor is excited all the same
}

INSTANTIATE_TEST_SUITE_P(Rigs, TestSignals,
                         testing::Values(Pairing{"flexible_rotor", "flexible_rotor_commissioned"},
                                         Pairing{"flexible_rotor", "flexible_rotor"},
                                         Pairing{"geared_rotor_4dof", "geared_rotor"},
                                         Pairing{"geared_rotor_12dof", "geared_rotor"}),
                         [](const auto& parameter) {
                           return std::string(parameter.param.rig) + "_under_" +
                                  parameter.param.controller;
                         });

scenario::Step AllAxes(const RigNumbers& rig, scenario::SignalKind kind) {
  scenario::Step step;
  step.hold_s = 1.5;
  step.orbit_limit_m = 0.3 * rig.clearance_m;
  for (std::size_t axis = 0; axis < rig.axes(); ++axis) {
    scenario::Excitation e;
    e.axis = axis;
    e.channel = rig.channels[axis];
    e.kind = kind;
    e.amplitude_a = 1.0;
    e.order = 10;
    e.divisor = 20;
    e.repeat_s = 0.5;
    e.width_s = 5e-3;
    step.excitation.push_back(e);
  }
  return step;
}

/// 1 A on all four axes at 3000 rpm at the default limit of the orbit, asked for over the network.
LifeResult OneAmpere(scenario::SignalKind kind, bool guarded) {
  const LifeRig rig = LoadLifeRig("flexible_rotor", "flexible_rotor_commissioned");
  LifePlan plan = DrawSignals(1, 3000.0, rig.config.rig);
  plan.plays_scenario = false;
  plan.guards_signals = guarded;
  plan.signals = {AllAxes(rig.config.rig, kind)};
  // It depends on the rotor's angle whether the impulse touches without the guard.
  plan.actions = {{.at_ns = 0, .deed = Deed::kCommand, .command = OperatorCommand::kLift},
                  {.at_ns = 1'400'000'000,
                   .deed = Deed::kCommand,
                   .command = OperatorCommand::kSpin,
                   .speed_rpm = 3000.0,
                   .rpm_per_s = 2000.0},
                  {.at_ns = 3'212'000'000, .deed = Deed::kExcite}};
  return RunLife(rig, plan);
}

class TestSignalPair : public testing::TestWithParam<scenario::SignalKind> {};

TEST_P(TestSignalPair, OfTheWholeCurrentOnAllAxesTouchesWithoutTheGuardOnly) {
  EXPECT_GT(OneAmpere(GetParam(), false).excited_contacts, 0U);
  const LifeResult guarded = OneAmpere(GetParam(), true);
  EXPECT_EQ(guarded.excited_contacts, 0U);
  EXPECT_TRUE(guarded.harms.empty());
  EXPECT_GT(guarded.most_excitation_a, 0.4);  // 0.6 of 1 A in each bearing, both axes alike
  EXPECT_GT(guarded.reduced.cycles[0], 0U);   // and it is counted
}

INSTANTIATE_TEST_SUITE_P(Kinds, TestSignalPair,
                         testing::Values(scenario::SignalKind::kPrbs,
                                         scenario::SignalKind::kImpulse));

}  // namespace
}  // namespace levitas::lives

// The safe states of docs/safety.md against what one might do instead, on the nonlinear plant.

#include <gtest/gtest.h>

#include <cmath>

#include "common/rotational_speed.hpp"
#include "tests/loop/levitation/closed_loop.hpp"

namespace levitas::test {
namespace {

enum class Reaction { kLevitatedStop, kControlCurrentToZero, kBothCoilsOff };

// What the touchdown bearings get in half a second and until standstill.
struct Harm {
  Extremes most;
  double static_force_n{};  ///< largest contact force after the rotor has come to rest
};

Harm Trip(Reaction reaction, double speed_rpm) {
  ClosedLoop loop(Only(Fault::kNone), RollingTouchdownRig());
  EXPECT_TRUE(loop.Levitate());
  loop.SpinAt(speed_rpm);
  double share = 1.0;
  const auto brake = [](plant::PlantCommand& command) {
    command.drive_enabled = true;
    command.speed_set_point_rad_per_s = 0.0;
    command.acceleration_limit_rad_per_s2 = RpmToRadPerS(1000.0);
  };
  if (reaction == Reaction::kLevitatedStop) {
    loop.Command(OperatorCommand::kEmergencyStop);
  } else if (reaction == Reaction::kControlCurrentToZero) {
    loop.overrule = [&, brake](plant::PlantCommand& command) {
      share = std::max(0.0, share - 1.0 / 500.0);  // within 50 ms, bias left on
      for (double& current_a : command.control_current_a) current_a *= share;
      command.bias_current_a = 1.0;
      command.amplifiers_enabled = true;
      brake(command);
    };
  } else {
    loop.overrule = [brake](plant::PlantCommand& command) {
      command.amplifiers_enabled = false;
      brake(command);
    };
  }
  loop.Run(speed_rpm / 1000.0 + 1.5);
  EXPECT_LT(loop.speed_rpm(), 5.0);
  Harm harm{loop.most, 0.0};
  loop.Reset();
  loop.Run(0.2);
  harm.static_force_n = loop.most.contact_n;
  return harm;
}

TEST(SafeStatePair, LevitatedStopNeverTouchesUntilItIsLowered) {
  for (const double speed_rpm : {3000.0, 6000.0}) {
    const Harm stop = Trip(Reaction::kLevitatedStop, speed_rpm);
    EXPECT_EQ(stop.most.contact_work_j, 0.0);  // no contact while turning
    const Harm drop = Trip(Reaction::kBothCoilsOff, speed_rpm);
    EXPECT_GT(drop.most.contact_work_j, 1.0);
    EXPECT_LT(stop.most.contact_n, 0.5 * drop.most.contact_n);
  }
}

// Bias without control current is a spring of stiffness -ks: at the touchdown radius it pulls
// outwards with k (i0/(s0-r))^2 - k (i0/(s0+r))^2 per axis, several times the rotor's weight.
TEST(SafeStatePair, ZeroControlCurrentWithBiasPressesTheRotorIntoItsTouchdownBearing) {
  const Harm biased = Trip(Reaction::kControlCurrentToZero, 3000.0);
  const Harm released = Trip(Reaction::kBothCoilsOff, 3000.0);
  // At rest after a release a bearing carries its share, at most 12.1 N (see the static balance);
  // 5 % for what is left of the bounce.
  EXPECT_LT(released.static_force_n, 1.05 * 12.2);
  // With bias the magnets pull outwards as well, k/s0^2 = 10 N/A^2: least where the rotor lies
  // between the axes (both at 190/sqrt(2) um), most where it lies on one axis.
  const auto pull_n = [](double radius_m) {
    const double r = radius_m / 0.381e-3;
    return 10.0 * (1.0 / ((1.0 - r) * (1.0 - r)) - 1.0 / ((1.0 + r) * (1.0 + r)));
  };
  EXPECT_GT(biased.static_force_n, std::sqrt(2.0) * pull_n(190e-6 / std::sqrt(2.0)));  // 26 N
  EXPECT_LT(biased.static_force_n, 12.2 + pull_n(192e-6));                             // 48 N
  EXPECT_GT(biased.most.contact_work_j, 2.0 * released.most.contact_work_j);
}

// At 6000 rpm the extra load feeds the backward whirl that friction drives: the journal goes far
// beyond the bearing's give, while the released rotor stays within 30 um of its clearance.
TEST(SafeStatePair, AtFullSpeedZeroControlCurrentWithBiasEndsInDryWhirl) {
  const Harm biased = Trip(Reaction::kControlCurrentToZero, 6000.0);
  const Harm released = Trip(Reaction::kBothCoilsOff, 6000.0);
  EXPECT_LT(released.most.shaft_m, 220e-6);
  EXPECT_GT(biased.most.shaft_m, 2.0 * released.most.shaft_m);
}

// A levitated stop whose feedback is lost on the way turns into a release.
TEST(SafeState, LevitatedStopEndsInAReleaseWhenTheFeedbackIsLost) {
  ClosedLoop loop(ShippedCycle(), RollingTouchdownRig());
  ASSERT_TRUE(loop.Levitate());
  loop.SpinAt(3000.0);
  loop.Command(OperatorCommand::kEmergencyStop);
  loop.Run(1.0);
  ASSERT_EQ(loop.state(), supervisor::State::kTrippedStopping);
  loop.disturb = [](cycle::CycleInputs& in) { in.frame.position_m[3] = 400e-6; };
  loop.Run(0.01);
  EXPECT_EQ(loop.state(), supervisor::State::kTrippedReleased);
  EXPECT_EQ(loop.out.fault, Fault::kEmergencyStop);  // the first cause stays
  EXPECT_EQ(loop.out.current.bias_current_a, 0.0);
  loop.Run(4.0);
  EXPECT_LT(loop.speed_rpm(), 5.0);
}

}  // namespace
}  // namespace levitas::test

// Self-test and lift: a rig that is not fit to levitate is told so before, or soon after, its
// magnets are on; without the check they pull on regardless.

#include <gtest/gtest.h>

#include <cmath>

#include "common/rotational_speed.hpp"
#include "tests/loop/levitation/closed_loop.hpp"

namespace levitas::test {
namespace {

constexpr double kWeightN = 2.333 * 9.81;

/// Nothing else may catch it, the lift's own time included.
cycle::CycleConfig WithoutLiftTimeout() {
  cycle::CycleConfig config = Only(Fault::kNone);
  config.supervisor.sequence.lift_timeout_s = 1e4;
  return config;
}

// Coils of one axis wired the wrong way round: the law drives the rotor away from the centre.
TEST(LiftFailedPair, CrossedCoilsPullForEverUnlessTheLiftIsGivenUp) {
  const auto lift = [](const cycle::CycleConfig& config) {
    cycle::CycleConfig crossed = config;
    crossed.rig.actuator_polarity[0] = -1;
    ClosedLoop loop(crossed);
    loop.Command(OperatorCommand::kLift);
    loop.Run(6.0);
    loop.Reset();
    loop.Run(0.5);
    return std::pair{loop.most.contact_n, loop.out};
  };
  const auto [without_n, pulling] = lift(WithoutLiftTimeout());
  EXPECT_EQ(pulling.fault, Fault::kNone);
  EXPECT_TRUE(pulling.current.amplifiers_enabled);
  EXPECT_GT(without_n, kWeightN);  // pressed onto its bearing with more than it weighs
  const auto [with_n, released] = lift(Only(Fault::kNone));
  EXPECT_EQ(released.fault, Fault::kLiftFailed);
  EXPECT_FALSE(released.current.amplifiers_enabled);
  EXPECT_EQ(released.current.bias_current_a, 0.0);
  EXPECT_LT(with_n, 1.05 * 0.53 * kWeightN);  // its own weight: the larger share is 12.1 of 22.9 N
}

// A rotor that nobody can lift: it stays where it is, whatever the magnets do.
TEST(LiftFailedPair, RotorTooHeavyIsNotPulledAtForEver) {
  const auto lift = [](const cycle::CycleConfig& config) {
    plant::PlantConfig rig = RollingTouchdownRig();
    rig.gravity_m_per_s2 = 9.81 * 12.0;  // more than 1 A of control current can lift
    ClosedLoop loop(config, rig);
    loop.Command(OperatorCommand::kLift);
    loop.Run(5.0);
    return loop.out;
  };
  const auto pulling = lift(WithoutLiftTimeout());
  EXPECT_TRUE(pulling.current.amplifiers_enabled);
  EXPECT_NE(pulling.saturated_axes, 0);  // with all it has
  const auto released = lift(Only(Fault::kNone));
  EXPECT_EQ(released.fault, Fault::kLiftFailed);
  EXPECT_EQ(released.current.bias_current_a, 0.0);
}

struct SelfTestCase {
  const char* name;
  double offset_m;   ///< of the first probe
  double speed_rpm;  ///< the shaft turns although nobody asked for it
};

class SelfTest : public testing::TestWithParam<SelfTestCase> {};

cycle::CycleOutputs Lift(const cycle::CycleConfig& config, const SelfTestCase& test,
                         double* coil_a) {
  ClosedLoop loop(config, RollingTouchdownRig());
  loop.plant.SetSpeed(RpmToRadPerS(test.speed_rpm), 0.0);
  loop.disturb = [&](cycle::CycleInputs& in) { in.frame.position_m[0] += test.offset_m; };
  loop.Command(OperatorCommand::kLift);
  loop.Run(1.0);
  *coil_a = loop.most.high_coil_a;
  return loop.out;
}

// A probe that has slipped in its holder, or a shaft that turns: never energised. Without the
// check the magnets are on within a second.
TEST_P(SelfTest, EnergisesNothingOnARigThatIsNotFit) {
  double without_a = 0.0;
  double with_a = 0.0;
  cycle::CycleConfig blind = Only(Fault::kNone);
  blind.supervisor.sequence.standstill_rad_per_s = 1e6;
  blind.rig.clearance_m = 1e-3;  // nothing a probe can read lies beyond 1.25 of it
  blind.rig.clearances_m.clear();
  const auto without = Lift(blind, GetParam(), &without_a);
  EXPECT_NE(without.fault, Fault::kSelfTestFailed);
  EXPECT_GT(without_a, 1.0);  // bias and more
  const auto with = Lift(Only(Fault::kSensorOutOfRange), GetParam(), &with_a);
  // A shaft that is seen to turn is not even tested: the command is refused.
  EXPECT_EQ(with.fault, GetParam().speed_rpm > 0.0 ? Fault::kNone : Fault::kSelfTestFailed);
  EXPECT_EQ(with.mode, GetParam().speed_rpm > 0.0 ? Mode::kOff : Mode::kTripped);
  EXPECT_LT(with_a, 0.0);  // no coil was ever commanded on (the initial value)
}

INSTANTIATE_TEST_SUITE_P(EveryReason, SelfTest,
                         testing::Values(SelfTestCase{"ProbeSlipped", -200e-6, 0.0},
                                         SelfTestCase{"ShaftTurns", 0.0, 600.0}),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace levitas::test

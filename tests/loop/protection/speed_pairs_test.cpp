// What a wrong speed does to a rotor that runs down: with a controller that believes each reading,
// and with the shipped one.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/loop/levitation/closed_loop.hpp"

namespace levitas::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Of a drive that could have brought the rotor to any speed at once: no reading contradicts.
cycle::CycleConfig Credulous() {
  cycle::CycleConfig config = ShippedCycle();
  config.rig.max_acceleration_rad_per_s2 = 1e12;
  return config;
}

struct RunDown {
  double turning_contact_n{};  ///< largest force in a touchdown bearing above 100 rpm
  double released_rpm{};       ///< speed when the amplifiers went off
  cycle::CycleOutputs out;
};

/// An emergency stop at 3000 rpm; 0.5 s later `misread` begins, for `frames` of them.
RunDown Stop(const cycle::CycleConfig& config, double misread, long frames) {
  ClosedLoop loop(config, RollingTouchdownRig());
  EXPECT_TRUE(loop.Levitate());
  loop.SpinAt(3000.0);
  loop.Command(OperatorCommand::kEmergencyStop);
  RunDown run;
  for (long n = 0; n < 80'000; ++n) {
    loop.disturb = [&](cycle::CycleInputs& in) {
      if (n >= 5'000 && n < 5'000 + frames) in.frame.speed_rad_per_s = misread;
    };
    const bool energised = loop.out.current.amplifiers_enabled;
    (void)loop.Step();
    if (energised && !loop.out.current.amplifiers_enabled) run.released_rpm = loop.speed_rpm();
    if (loop.speed_rpm() > 100.0) {
      run.turning_contact_n = std::max(run.turning_contact_n, loop.plant.ContactForce());
    }
  }
  loop.disturb = nullptr;
  run.out = loop.out;
  return run;
}

TEST(StuckSpeedPair, AZeroThatLastsLowersATurningRotorUnlessItIsContradicted) {
  const RunDown without = Stop(Credulous(), 0.0, 80'000);
  EXPECT_GT(without.released_rpm, 1000.0);
  EXPECT_GT(without.turning_contact_n, 10.0);
  const RunDown with = Stop(ShippedCycle(), 0.0, 80'000);
  EXPECT_EQ(with.turning_contact_n, 0.0);
  EXPECT_FALSE(with.out.current.amplifiers_enabled);
  EXPECT_LT(with.released_rpm, 5.0);
}

TEST(SpeedGlitchPair, ASingleZeroInTheRunDownIsNoStandstill) {
  for (const double misread : {0.0, -0.2, kNan, 1e4}) {
    const RunDown run = Stop(ShippedCycle(), misread, 1);
    EXPECT_EQ(run.turning_contact_n, 0.0);
    EXPECT_LT(run.released_rpm, 5.0);
    EXPECT_FALSE(run.out.current.amplifiers_enabled);
  }
}

// Even a controller that took the zero for standstill gives the landing up when the rotor turns.
TEST(GivenUpLandingPair, ATurningRotorIsCaughtAgainBeforeItTouches) {
  cycle::CycleConfig credulous = Credulous();
  const RunDown run = Stop(credulous, 0.0, 2'500);  // 0.2 s prove it, then 50 ms of landing
  EXPECT_EQ(run.turning_contact_n, 0.0);
  EXPECT_LT(run.released_rpm, 5.0);
  EXPECT_EQ(run.out.fault, Fault::kEmergencyStop);
}

TEST(SpeedNotFinitePair, LeavesASpinningRotorLevitatedUnderTheBrake) {
  for (const double bad : {kNan, std::numeric_limits<double>::infinity()}) {
    ClosedLoop loop(ShippedCycle(), RollingTouchdownRig());
    ASSERT_TRUE(loop.Levitate());
    loop.SpinAt(3000.0);
    loop.disturb = [&](cycle::CycleInputs& in) { in.frame.speed_rad_per_s = bad; };
    (void)loop.Step();
    EXPECT_EQ(loop.out.fault, Fault::kNone);
    loop.Run(4.0);
    EXPECT_EQ(loop.out.fault, Fault::kSpeedUnknown);
    EXPECT_TRUE(loop.out.current.amplifiers_enabled);
    EXPECT_EQ(loop.most.contact_n, 0.0);
    EXPECT_LT(loop.speed_rpm(), 5.0);
    loop.disturb = nullptr;  // numbers come back: it is landed
    loop.Run(1.5);
    EXPECT_FALSE(loop.out.current.amplifiers_enabled);
  }
}

// Another controller died; its rotor turns in the touchdown bearings.
TEST(TurningRotorAtStartPair, IsBrakedBeforeAnythingIsLifted) {
  const auto speed_after = [](bool seen) {
    ClosedLoop loop(ShippedCycle(), RollingTouchdownRig());
    loop.plant.SetSpeed(RpmToRadPerS(3000.0), 0.0);
    if (!seen) loop.disturb = [](cycle::CycleInputs& in) { in.frame_present = false; };
    loop.Run(0.1);
    if (seen) {
      loop.Command(OperatorCommand::kLift);
      EXPECT_TRUE(loop.out.command_refused);
    }
    loop.Run(3.2);
    EXPECT_EQ(loop.out.fault, Fault::kNone);
    return loop.speed_rpm();
  };
  EXPECT_GT(speed_after(false), 2000.0);
  EXPECT_LT(speed_after(true), 5.0);
}

}  // namespace
}  // namespace levitas::test

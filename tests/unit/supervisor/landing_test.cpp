// Landing is for a rotor that stands: what happens when it turns all the same, before and after a
// trip, and with a controller that finds a turning rotor.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/unit/supervisor/supervisor_rig.hpp"

namespace levitas::supervisor {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Lifted from a resting place away from the centre, then told to land; the rotor follows.
class Lowered : public Driver {
 public:
  Lowered() {
    seen.position_m = {-100e-6, -90e-6, -80e-6, -70e-6};
    (void)Step(OperatorCommand::kLift);
    while (state() == State::kSelfTest) (void)Step();
    seen.position_m = {};
    while (state() == State::kLift) (void)Step();
  }
  void Follow(int cycles) {
    for (int i = 0; i < cycles; ++i) {
      seen.position_m = supervisor.decision().reference_m;
      (void)Step();
    }
  }
};

SupervisorConfig LongLanding() {
  SupervisorConfig config = TestConfig();
  config.sequence.landing_ramp_s = 0.1;  // longer than the 20 ms that prove a turning rotor
  return config;
}

TEST(GivenUpLanding, ATurningRotorIsBrakedLevitatedAndLandedWhenItStands) {
  Driver driver(LongLanding());
  driver.GoTo(State::kLanding);
  driver.seen.speed_rad_per_s = 200.0;
  EXPECT_EQ(driver.Steps(199).state, State::kLanding);  // 20 ms
  const Decision& decision = driver.Step();
  EXPECT_EQ(decision.state, State::kTrippedStopping);
  EXPECT_EQ(decision.latch.finding.fault, Fault::kSpeedUnknown);
  EXPECT_EQ(decision.latch.finding.value, 200.0);
  EXPECT_EQ(decision.latch.finding.limit, 1.0);
  EXPECT_TRUE(decision.drive_enabled);
  EXPECT_EQ(driver.Steps(2000).state, State::kTrippedStopping);
  driver.seen.speed_rad_per_s = 0.0;
  EXPECT_EQ(driver.Steps(5).state, State::kTrippedLanding);
  EXPECT_EQ(driver.Steps(1001).state, State::kTrippedReleased);
}

TEST(GivenUpLanding, AlsoAfterATripAndWithItsFirstCause) {
  Driver driver(LongLanding());
  driver.GoTo(State::kTrippedLanding);
  driver.seen.speed_rad_per_s = 200.0;
  EXPECT_EQ(driver.Steps(199).state, State::kTrippedLanding);
  EXPECT_TRUE(driver.supervisor.decision().drive_enabled);
  EXPECT_EQ(driver.Step().state, State::kTrippedStopping);
  EXPECT_EQ(driver.supervisor.decision().latch.finding.fault, Fault::kEmergencyStop);
}

TEST(GivenUpLanding, TheReferenceReturnsToTheCentreWithoutAStep) {
  Lowered rotor;
  (void)rotor.Step(OperatorCommand::kLand);
  rotor.Follow(8);
  const Decision& decision = rotor.supervisor.decision();
  AxisArray last_m = decision.reference_m;
  ASSERT_LT(last_m[0], -80e-6);
  (void)rotor.Step(OperatorCommand::kEmergencyStop);
  rotor.seen.speed_rad_per_s = 300.0;
  for (int i = 0; i < 25; ++i) {
    rotor.Follow(1);
    EXPECT_EQ(decision.state, State::kTrippedStopping);
    // Steepest slope of 3 p^2 - 2 p^3 is 1.5 ramps per ramp time, of 20 cycles.
    EXPECT_LE(std::abs(decision.reference_m[0] - last_m[0]), 1.5 * 100e-6 / 20.0);
    last_m = decision.reference_m;
  }
  EXPECT_EQ(last_m, AxisArray{});
}

// Near the wall the magnets of a soft law pull the rotor over to where it will lie: no orbit. The
// same distance to the other side is one; the limit is 100 um, the resting place 135 um away.
TEST(GivenUpLanding, NotByARotorThatIsAtItsRestingPlaceBeforeItsReference) {
  for (const bool to_its_place : {true, false}) {
    Lowered rotor;
    (void)rotor.Step(OperatorCommand::kLand);
    rotor.Follow(1);
    const double sign = to_its_place ? 1.0 : -1.0;
    rotor.seen.position_m = {-100e-6 * sign, -90e-6 * sign, -80e-6, -70e-6};
    const Fault fault = rotor.Steps(4).latch.finding.fault;
    EXPECT_EQ(fault, to_its_place ? Fault::kNone : Fault::kOrbitExceeded);
  }
}

// The rotor lies against the touchdown bearing where its landing is given up: this contact is no
// reason to let it fall, but one that outlasts the return is.
TEST(GivenUpLanding, CountsContactOnlyOnceTheRotorShouldBeBack) {
  SupervisorConfig config = TestConfig();
  config.sequence.landing_ramp_s = 0.1;
  config.sequence.lift_ramp_s = 0.05;
  config.sequence.lift_timeout_s = 1.0;
  for (const bool comes_back : {true, false}) {
    Driver driver(config);
    driver.seen.position_m = {-201e-6, 0.0, 0.0, 0.0};
    (void)driver.Step(OperatorCommand::kLift);
    while (driver.state() == State::kSelfTest) (void)driver.Step();
    driver.seen.position_m = {};
    while (driver.state() == State::kLift) (void)driver.Step();
    (void)driver.Step(OperatorCommand::kLand);
    for (int i = 0; i < 950; ++i) {
      driver.seen.position_m = driver.supervisor.decision().reference_m;
      if (i > 700) driver.seen.position_m = {-201e-6, 0.0, 0.0, 0.0};
      if (i > 748) driver.seen.speed_rad_per_s = 200.0;
      (void)driver.Step();
    }
    ASSERT_EQ(driver.state(), State::kTrippedStopping);
    for (int i = 0; i < 1000; ++i) {
      if (comes_back) driver.seen.position_m = driver.supervisor.decision().reference_m;
      (void)driver.Step();
    }
    EXPECT_EQ(driver.state(), comes_back ? State::kTrippedStopping : State::kTrippedReleased);
  }
}

// Time inside is counted back, not forgotten: 15 ms in contact, 5 ms inside, 10 ms in contact.
TEST(Contact, CountsBackAndNotFromZeroWhatLiesInside) {
  Driver driver;
  driver.GoTo(State::kTrippedStopping);
  driver.seen.position_m = {201e-6, 0.0, 0.0, 0.0};  // clearance 200 um, 20 ms are 200 cycles
  (void)driver.Steps(150);
  driver.seen.position_m = {};
  (void)driver.Steps(50);
  driver.seen.position_m = {201e-6, 0.0, 0.0, 0.0};
  EXPECT_EQ(driver.Steps(99).state, State::kTrippedStopping);
  EXPECT_EQ(driver.supervisor.decision().released.fault, Fault::kNone);
  EXPECT_EQ(driver.Step().state, State::kTrippedReleased);
  EXPECT_EQ(driver.supervisor.decision().released.fault, Fault::kOrbitExceeded);
}

TEST(Contact, GoesOnWhileFramesAreMissing) {
  SupervisorConfig config = TestConfig();
  config.protection.frame_missing_cycles = 1000;
  Driver driver(config);
  driver.GoTo(State::kTrippedStopping);
  driver.seen.position_m = {201e-6, 0.0, 0.0, 0.0};
  (void)driver.Step();
  driver.seen.fresh = false;
  EXPECT_EQ(driver.Steps(198).state, State::kTrippedStopping);
  EXPECT_EQ(driver.Step().state, State::kTrippedReleased);
}

TEST(Off, BrakesARotorThatTurnsAndRefusesToLiftIt) {
  Driver driver;
  driver.seen.speed_rad_per_s = -300.0;
  const Decision& decision = driver.Step();
  EXPECT_EQ(decision.state, State::kOff);
  EXPECT_TRUE(decision.turning);
  EXPECT_TRUE(decision.drive_enabled);
  EXPECT_EQ(decision.speed_set_point_rad_per_s, 0.0);
  EXPECT_EQ(decision.acceleration_rad_per_s2, 77.0);
  EXPECT_TRUE(driver.Step(OperatorCommand::kLift).command_refused);
  EXPECT_EQ(driver.state(), State::kOff);
  EXPECT_EQ(decision.latch.finding.fault, Fault::kNone);
  driver.seen.fresh = false;
  EXPECT_TRUE(driver.Steps(100).drive_enabled);
  driver.seen.fresh = true;
  driver.seen.speed_rad_per_s = 0.0;
  EXPECT_FALSE(driver.Step().drive_enabled);
  EXPECT_EQ(driver.Step(OperatorCommand::kLift).state, State::kSelfTest);
}

TEST(Off, TellsTheDriveOfAnUnknownRigAndOfARotorAtRestNothing) {
  Driver driver;
  driver.seen.fresh = false;
  EXPECT_FALSE(driver.Steps(100).drive_enabled);
  driver.seen.fresh = true;
  driver.seen.speed_rad_per_s = 0.5;
  EXPECT_FALSE(driver.Steps(100).drive_enabled);
  EXPECT_EQ(driver.supervisor.decision().acceleration_rad_per_s2, 0.0);
}

TEST(Off, RefusesALiftWhileTheSpeedIsNoNumber) {
  Driver driver;
  driver.seen.speed_rad_per_s = kNan;
  (void)driver.Steps(2000);  // 0.2 s
  EXPECT_TRUE(driver.Step(OperatorCommand::kLift).command_refused);
  EXPECT_EQ(driver.supervisor.decision().latch.finding.fault, Fault::kNone);
}

TEST(UnknownSpeed, NeverReleasesALevitatedRotor) {
  for (const State state : {State::kLevitating, State::kSpinning, State::kCoastDown}) {
    for (const double bad : {kNan, HUGE_VAL}) {
      Driver driver;
      driver.GoTo(state);
      driver.seen.speed_rad_per_s = bad;
      const Decision& one = driver.Step();
      EXPECT_EQ(one.latch.finding.fault, Fault::kNone) << Name(state);
      (void)driver.Steps(2100);
      EXPECT_EQ(driver.state(), State::kTrippedStopping) << Name(state);
      EXPECT_EQ(one.latch.finding.fault, Fault::kSpeedUnknown);
      EXPECT_TRUE(one.drive_enabled);
      EXPECT_EQ(driver.Steps(20'000).state, State::kTrippedStopping);
    }
  }
}

TEST(SelfTest, WaitsForTheProofThatTheRotorStands) {
  SupervisorConfig config = TestConfig();
  config.sequence.standstill_s = 0.01;
  Driver driver(config);
  (void)driver.Step(OperatorCommand::kLift);
  EXPECT_EQ(driver.Steps(98).state, State::kSelfTest);  // 1 ms of its own, 10 ms of standstill
  EXPECT_EQ(driver.Step().state, State::kLift);
}

}  // namespace
}  // namespace levitas::supervisor

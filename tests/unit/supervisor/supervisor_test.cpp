#include "controller/supervisor/supervisor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "tests/unit/supervisor/supervisor_rig.hpp"

namespace levitas::supervisor {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(SelfTest, LastsItsTimeThenLifts) {
  Driver driver;
  (void)driver.Step(OperatorCommand::kLift);
  EXPECT_EQ(driver.Steps(10).state, State::kSelfTest);  // 1 ms at 10 kHz
  EXPECT_EQ(driver.Step().state, State::kLift);
  EXPECT_TRUE(driver.supervisor.decision().start_law);
  EXPECT_FALSE(driver.Step().start_law);
}

TEST(SelfTest, FailsForARotorBeyondTheTouchdownBearing) {
  Driver driver;
  driver.seen.position_m = {0.0, 0.0, 200e-6, 200e-6};  // radius 283 um, allowed 1.25 x 200 um
  (void)driver.Step(OperatorCommand::kLift);
  const Decision& decision = driver.Steps(4);
  EXPECT_EQ(decision.state, State::kTrippedReleased);
  EXPECT_EQ(decision.latch.finding.fault, Fault::kSelfTestFailed);
  EXPECT_GE(decision.latch.finding.axis, 2);
  EXPECT_NEAR(decision.latch.finding.value, 283e-6, 1e-6);
  EXPECT_DOUBLE_EQ(decision.latch.finding.limit, 250e-6);
}

TEST(SelfTest, FailsForATurningRotor) {
  Driver driver;
  (void)driver.Step(OperatorCommand::kLift);
  driver.seen.speed_rad_per_s = -5.0;
  const Decision& decision = driver.Steps(4);
  EXPECT_EQ(decision.latch.finding.fault, Fault::kSelfTestFailed);
  EXPECT_EQ(decision.latch.finding.axis, -1);
  EXPECT_EQ(decision.latch.finding.value, 5.0);
}

TEST(SelfTest, FailsForADeadSensor) {
  Driver driver;
  driver.seen.frozen[3] = true;
  (void)driver.Step(OperatorCommand::kLift);
  const Decision& decision = driver.Steps(8);
  EXPECT_EQ(decision.latch.finding.fault, Fault::kSensorFrozen);
  EXPECT_EQ(decision.latch.finding.axis, 3);
}

TEST(Lift, MovesTheReferenceFromTheRestingPlaceToTheCentreWithoutAStep) {
  Driver driver;
  driver.seen.position_m = {-100e-6, 50e-6, -100e-6, 50e-6};
  (void)driver.Step(OperatorCommand::kLift);
  while (driver.state() == State::kSelfTest) (void)driver.Step();
  AxisArray last = driver.supervisor.decision().reference_m;
  EXPECT_NEAR(last[0], -100e-6, 1e-7);  // 1e-7: the wiggle of the observations
  EXPECT_NEAR(last[1], 50e-6, 1e-7);
  for (int i = 0; i < 20; ++i) {
    const AxisArray now = driver.Step().reference_m;
    EXPECT_GT(now[0], last[0]);
    EXPECT_LT(now[1], last[1]);
    // Steepest slope of 3 p^2 - 2 p^3 is 1.5 ramps per ramp time, here of 20 cycles.
    EXPECT_LE(now[0] - last[0], 1.5 * 100.2e-6 / 20.0);
    last = now;
  }
  EXPECT_EQ(last[0], 0.0);
}

TEST(Lift, WaitsUntilTheRotorHasSettled) {
  Driver driver;
  driver.GoTo(State::kLift);
  driver.seen.position_m = {50e-6, 0.0, 0.0, 0.0};
  EXPECT_EQ(driver.Steps(60).state, State::kLift);
  driver.seen.position_m = {};
  EXPECT_EQ(driver.Steps(4).state, State::kLift);
  EXPECT_EQ(driver.Step().state, State::kLevitating);
}

// In real time a frame may come late; the rotor has settled all the same (five fresh frames).
TEST(Lift, NeitherCountsNorForgetsWhenAFrameIsMissing) {
  Driver driver;
  driver.GoTo(State::kLift);
  driver.seen.position_m = {50e-6, 0.0, 0.0, 0.0};
  EXPECT_EQ(driver.Steps(60).state, State::kLift);
  driver.seen.position_m = {};
  for (int frame = 1; frame <= 5; ++frame) {
    driver.seen.fresh = false;
    EXPECT_EQ(driver.Step().state, State::kLift) << "before frame " << frame;
    driver.seen.fresh = true;
    EXPECT_EQ(driver.Step().state == State::kLevitating, frame == 5) << "with frame " << frame;
  }
}

TEST(Lift, FailsAfterItsTimeAndReleases) {
  Driver driver;
  driver.GoTo(State::kLift);
  driver.seen.position_m = {0.0, 0.0, 0.0, -50e-6};
  const Decision& decision = driver.Steps(101);  // the time-out of 100 cycles has passed
  EXPECT_EQ(decision.latch.finding.fault, Fault::kLiftFailed);
  EXPECT_EQ(decision.latch.finding.axis, 3);
  EXPECT_NEAR(decision.latch.finding.value, 50e-6, 1e-7);
  EXPECT_EQ(decision.latch.finding.limit, 20e-6);
  EXPECT_EQ(decision.state, State::kTrippedReleased);
}

TEST(Spin, RefusesSpeedsAndAccelerationsThatCannotBe) {
  for (const auto& [speed, acceleration] : {std::pair{601.0, 50.0},
                                            {-601.0, 50.0},
                                            {kNan, 50.0},
                                            {300.0, 0.0},
                                            {300.0, -1.0},
                                            {300.0, kNan},
                                            {300.0, 61.0},
                                            {300.0, HUGE_VAL}}) {
    RigNumbers rig = TestRig();
    rig.max_acceleration_rad_per_s2 = 60.0;
    Driver driver(rig);
    driver.GoTo(State::kLevitating);
    const Decision& decision = driver.Step({OperatorCommand::kSpin, speed, acceleration});
    EXPECT_TRUE(decision.command_refused) << speed << " " << acceleration;
    EXPECT_EQ(decision.state, State::kLevitating);
    EXPECT_FALSE(decision.drive_enabled);
  }
}

TEST(Spin, ReturnsToLevitatingOnlyWhenToldToStand) {
  Driver driver;
  driver.GoTo(State::kSpinning);
  driver.seen.speed_rad_per_s = 0.0;
  EXPECT_EQ(driver.Step().state, State::kSpinning);  // set point 300 rad/s: about to turn
  driver.seen.speed_rad_per_s = 100.0;
  (void)driver.Step({OperatorCommand::kSpin, 0.0, 50.0});
  EXPECT_EQ(driver.Step().state, State::kSpinning);
  driver.seen.speed_rad_per_s = 0.5;
  EXPECT_EQ(driver.Steps(4).state, State::kSpinning);
  EXPECT_EQ(driver.Step().state, State::kLevitating);
}

TEST(Landing, IsRefusedWhileTheRotorTurnsAndTakenWhenItStands) {
  for (const State state : {State::kSpinning, State::kCoastDown}) {
    Driver driver;
    driver.GoTo(state);
    EXPECT_TRUE(driver.Step(OperatorCommand::kLand).command_refused);
    (void)driver.Step(Request{OperatorCommand::kSpin, 1.0, 50.0});  // still wanted to turn
    driver.seen.speed_rad_per_s = 0.0;
    (void)driver.Steps(4);
    EXPECT_EQ(driver.state(), State::kSpinning);
    EXPECT_EQ(driver.Step(OperatorCommand::kLand).state, State::kLanding);
  }
}

TEST(Landing, LowersTheReferenceToTheRestingPlaceAndSwitchesOff) {
  Driver driver;
  driver.seen.position_m = {-90e-6, -80e-6, -70e-6, -60e-6};
  (void)driver.Step(OperatorCommand::kLift);
  while (driver.state() == State::kSelfTest) (void)driver.Step();
  driver.seen.position_m = {};
  while (driver.state() == State::kLift) (void)driver.Step();
  (void)driver.Step(OperatorCommand::kLand);
  const Decision& decision = driver.supervisor.decision();
  for (int i = 0; i < 10; ++i) {
    driver.seen.position_m = decision.reference_m;  // the rotor follows
    (void)driver.Step();
  }
  EXPECT_EQ(decision.state, State::kLanding);
  EXPECT_NEAR(decision.reference_m[0], -90e-6, 1e-7);
  EXPECT_NEAR(decision.reference_m[3], -60e-6, 1e-7);
  EXPECT_EQ(driver.Step().state, State::kOff);
}

TEST(LevitatedStop, BrakesStandsLandsAndReleases) {
  Driver driver;
  driver.GoTo(State::kSpinning);
  const Decision& decision = driver.Step(OperatorCommand::kEmergencyStop);
  EXPECT_EQ(decision.state, State::kTrippedStopping);
  EXPECT_TRUE(decision.drive_enabled);
  EXPECT_EQ(decision.speed_set_point_rad_per_s, 0.0);
  EXPECT_EQ(decision.acceleration_rad_per_s2, 77.0);
  EXPECT_EQ(driver.Steps(1000).state, State::kTrippedStopping);  // still turning
  driver.seen.speed_rad_per_s = 0.0;
  EXPECT_EQ(driver.Steps(4).state, State::kTrippedStopping);  // 0.5 ms at 10 kHz are not over
  EXPECT_EQ(driver.Step().state, State::kTrippedLanding);
  EXPECT_EQ(driver.Steps(11).state, State::kTrippedReleased);
  EXPECT_FALSE(driver.supervisor.decision().drive_enabled);
}

TEST(LevitatedStop, EscalatesToReleaseAndKeepsTheFirstCause) {
  for (const State state : {State::kTrippedStopping, State::kTrippedLanding}) {
    Driver driver;
    driver.GoTo(state);
    driver.seen.position_m[1] = kNan;
    EXPECT_EQ(driver.Step().state, State::kTrippedReleased);
    EXPECT_EQ(driver.supervisor.decision().latch.finding.fault, Fault::kEmergencyStop);
  }
}

TEST(LevitatedStop, GoesOnWithALargeOrbitButReleasesARotorThatRunsOnItsTouchdownBearings) {
  Driver driver;
  driver.GoTo(State::kTrippedStopping);
  driver.seen.position_m = {199e-6, 0.0, 0.0, 0.0};  // clearance 200 um
  EXPECT_EQ(driver.Steps(1000).state, State::kTrippedStopping);
  driver.seen.position_m = {201e-6, 0.0, 0.0, 0.0};
  EXPECT_EQ(driver.Steps(199).state, State::kTrippedStopping);  // 20 ms are 200 cycles
  EXPECT_EQ(driver.Step().state, State::kTrippedReleased);
  EXPECT_EQ(driver.supervisor.decision().latch.finding.fault, Fault::kEmergencyStop);
}

TEST(Release, KeepsBrakingARotorThatTurnsOrCannotBeSeen) {
  Driver driver;
  driver.GoTo(State::kSpinning);
  driver.seen.position_m[0] = kNan;
  EXPECT_TRUE(driver.Step().drive_enabled);
  EXPECT_EQ(driver.supervisor.decision().acceleration_rad_per_s2, 77.0);
  driver.seen.speed_rad_per_s = 0.0;
  EXPECT_TRUE(driver.Steps(4).drive_enabled);
  EXPECT_FALSE(driver.Step().drive_enabled);
  driver.seen.fresh = false;
  EXPECT_TRUE(driver.Step().drive_enabled);
}

TEST(Reset, IsRefusedUntilTheCauseIsGoneAndTheRotorStands) {
  Driver driver;
  driver.GoTo(State::kSpinning);
  driver.seen.rig_status = kRigAmplifierFault;
  (void)driver.Step();
  const auto refused = [&] { return driver.Step(OperatorCommand::kReset).command_refused; };
  EXPECT_TRUE(refused());  // fault bit, turning
  driver.seen.rig_status = 0;
  EXPECT_TRUE(refused());  // turning
  driver.seen.speed_rad_per_s = 0.0;
  EXPECT_TRUE(refused());  // for one frame only
  (void)driver.Steps(5);
  driver.seen.fresh = false;
  EXPECT_TRUE(refused());  // nothing seen
  driver.seen.fresh = true;
  driver.seen.position_m[2] = 390e-6;
  EXPECT_TRUE(refused());  // out of range
  driver.seen.position_m[2] = kNan;
  EXPECT_TRUE(refused());
  driver.seen.position_m[2] = 0.0;
  driver.seen.rig_status = kRigEmergencyStop;
  EXPECT_TRUE(refused());
  driver.seen.rig_status = 0;
  EXPECT_EQ(driver.supervisor.decision().latch.finding.fault, Fault::kAmplifierFault);
  EXPECT_FALSE(refused());
  EXPECT_EQ(driver.state(), State::kOff);
  EXPECT_EQ(driver.supervisor.decision().latch.finding.fault, Fault::kNone);
}

TEST(Reset, AfterARigRestartLeadsToANewLift) {
  Driver driver;
  driver.GoTo(State::kLevitating);
  driver.seen.rig_session = 2;
  EXPECT_EQ(driver.Step().latch.finding.fault, Fault::kRigRestarted);
  EXPECT_TRUE(driver.Step(OperatorCommand::kReset).command_refused);  // its rotor may turn
  (void)driver.Steps(4);
  (void)driver.Step(OperatorCommand::kReset);
  ASSERT_EQ(driver.state(), State::kOff);
  driver.GoTo(State::kLevitating);
  EXPECT_EQ(driver.state(), State::kLevitating);
}

// In real time the command to lift can fall into a cycle whose frame is missing.
TEST(Supervisor, TakesTheFirstFrameOfAllForNoRestartAlthoughLiftWasAskedBefore) {
  Driver driver;
  driver.seen.fresh = false;
  (void)driver.Step(OperatorCommand::kLift);
  driver.seen.fresh = true;
  driver.seen.rig_session = 77;
  EXPECT_EQ(driver.Step().latch.finding.fault, Fault::kNone);
  driver.seen.rig_session = 78;  // a restart during the self-test is still one
  EXPECT_EQ(driver.Step().latch.finding.fault, Fault::kRigRestarted);
}

TEST(Supervisor, RefusesACommandNumberItDoesNotKnow) {
  Driver driver;
  EXPECT_TRUE(driver.Step(static_cast<OperatorCommand>(99)).command_refused);
  EXPECT_EQ(driver.state(), State::kOff);
}

TEST(Supervisor, RefusesACommandInTheCycleOfATrip) {
  Driver driver;
  driver.GoTo(State::kSpinning);
  driver.seen.position_m[0] = kNan;
  EXPECT_TRUE(driver.Step(OperatorCommand::kSpin).command_refused);
  EXPECT_EQ(driver.state(), State::kTrippedReleased);
}

TEST(Supervisor, RefusesTimesAndRadiiThatCannotBe) {
  const auto throws = [](auto change) {
    SupervisorConfig config = TestConfig();
    change(config.sequence);
    try {
      Supervisor supervisor(TestRig(), config);
    } catch (const std::invalid_argument&) {
      return true;
    }
    return false;
  };
  EXPECT_FALSE(throws([](SequenceConfig&) {}));
  EXPECT_TRUE(throws([](SequenceConfig& s) { s.lift_ramp_s = -1.0; }));
  EXPECT_TRUE(throws([](SequenceConfig& s) { s.self_test_s = kNan; }));
  EXPECT_TRUE(throws([](SequenceConfig& s) { s.settle_radius_m = 0.0; }));
  EXPECT_TRUE(throws([](SequenceConfig& s) { s.standstill_rad_per_s = kNan; }));
  EXPECT_TRUE(throws([](SequenceConfig& s) { s.standstill_s = 0.0; }));
  EXPECT_TRUE(throws([](SequenceConfig& s) { s.standstill_s = kNan; }));
}

}  // namespace
}  // namespace levitas::supervisor

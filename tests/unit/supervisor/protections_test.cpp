// Each protection as a pair on observations: just below its limit nothing, at its limit the trip.
// The physical harm it prevents is shown in tests/loop/levitation.

#include "controller/supervisor/protections.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "common/random.hpp"
#include "tests/unit/supervisor/supervisor_rig.hpp"

namespace levitas::supervisor {
namespace {

TEST(OrbitProtection, TripsAfterItsCyclesBeyondTheFractionOfTheClearance) {
  const auto beyond = [](Seen& seen, int) { seen.position_m = {0, 0, 71e-6, -72e-6}; };
  EXPECT_EQ(TripAfter(State::kSpinning, 2, beyond).fault, Fault::kNone);
  const Finding found = TripAfter(State::kSpinning, 3, beyond);
  EXPECT_EQ(found.fault, Fault::kOrbitExceeded);
  EXPECT_EQ(found.axis, 3);                                    // the larger of the two axes
  EXPECT_NEAR(found.value, std::hypot(71e-6, 72e-6), 0.1e-6);  // wiggle of the observations
  EXPECT_DOUBLE_EQ(found.limit, 100e-6);
}

TEST(OrbitProtection, CountsBackWhatLiesInside) {
  // Of three cycles one beyond: never. Two of three, as a planar vibration at twice the limit has
  // them whatever its frequency: each third gains one period, the first two gain two at once.
  const auto share = [](int beyond) {
    return [beyond](Seen& seen, int i) {
      seen.position_m = {i % 3 < beyond ? 150e-6 : 0.0, 0, 0, 0};
    };
  };
  EXPECT_EQ(TripAfter(State::kSpinning, 300, share(1)).fault, Fault::kNone);
  EXPECT_EQ(TripAfter(State::kSpinning, 4, share(2)).fault, Fault::kNone);
  EXPECT_EQ(TripAfter(State::kSpinning, 5, share(2)).fault, Fault::kOrbitExceeded);
}

// A vibration at the wall, twice the limit, whatever its frequency and shape; and one just below
// the limit, a spike in every ten readings, and noise: nothing.
TEST(OrbitProtection, SeesAVibrationAtTheWallOfAnyFrequencyAndShape) {
  SupervisorConfig config = TestConfig();
  config.protection.orbit_cycles = 10;
  const auto after = [&](double amplitude_m, double frequency_hz, bool circular) {
    Driver driver(config);
    driver.GoTo(State::kSpinning);
    for (int i = 0; i < 1000; ++i) {  // 0.1 s
      const double angle_rad = 6.283185307179586 * frequency_hz * 1e-4 * i;
      driver.seen.position_m = {amplitude_m * std::cos(angle_rad),
                                circular ? amplitude_m * std::sin(angle_rad) : 0.0, 0.0, 0.0};
      if (driver.Step().latch.finding.fault != Fault::kNone) break;
    }
    return driver.supervisor.decision().latch.finding.fault;
  };
  for (const double frequency_hz : {50.0, 333.0, 400.0, 1000.0, 3300.0}) {
    for (const bool circular : {false, true}) {
      EXPECT_EQ(after(200e-6, frequency_hz, circular), Fault::kOrbitExceeded) << frequency_hz;
      EXPECT_EQ(after(99e-6, frequency_hz, circular), Fault::kNone) << frequency_hz;
    }
  }
  Driver driver(config);
  driver.GoTo(State::kSpinning);
  Random draw(20261125);
  for (int i = 0; i < 20'000; ++i) {
    for (double& at_m : driver.seen.position_m) at_m = 20e-6 * draw.Normal();
    if (i % 10 == 0) driver.seen.position_m[1] = 399e-6;
    (void)driver.Step();
  }
  EXPECT_EQ(driver.supervisor.decision().latch.finding.fault, Fault::kNone);
}

TEST(OrbitProtection, TakesARotorThatIsNotSeenForWhereItWasSeenLast) {
  // One frame beyond, then none: three periods as well.
  const auto unseen = [](Seen& seen, int i) {
    seen.position_m = {150e-6, 0, 0, 0};
    seen.fresh = i == 0;
  };
  EXPECT_EQ(TripAfter(State::kSpinning, 2, unseen).fault, Fault::kNone);
  EXPECT_EQ(TripAfter(State::kSpinning, 3, unseen).fault, Fault::kOrbitExceeded);
  const auto skipped = [](Seen& seen, int i) {
    seen.position_m = {150e-6, 0, 0, 0};
    seen.missed_deadlines = i == 1 ? 1 : 0;
  };
  EXPECT_EQ(TripAfter(State::kSpinning, 1, skipped).fault, Fault::kNone);
  EXPECT_EQ(TripAfter(State::kSpinning, 2, skipped).fault, Fault::kOrbitExceeded);
}

TEST(OrbitProtection, FollowsTheReferenceWhileTheRotorIsLowered) {
  const AxisArray rest_m{-100e-6, -90e-6, -80e-6, -70e-6};
  for (const bool follows : {true, false}) {
    Driver driver;
    driver.seen.position_m = rest_m;
    (void)driver.Step(OperatorCommand::kLift);
    while (driver.state() == State::kSelfTest) (void)driver.Step();
    driver.seen.position_m = {};
    while (driver.state() == State::kLift) (void)driver.Step();
    (void)driver.Step(OperatorCommand::kLand);
    while (driver.state() == State::kLanding) {
      const AxisArray reference_m = driver.supervisor.decision().reference_m;
      if (follows) driver.seen.position_m = reference_m;
      (void)driver.Step();
    }
    EXPECT_EQ(driver.state(), follows ? State::kOff : State::kTrippedStopping);
    EXPECT_EQ(driver.supervisor.decision().latch.finding.fault,
              follows ? Fault::kNone : Fault::kOrbitExceeded);
  }
}

TEST(OrbitProtection, LooksAtTheRadiusNotAtTheAxes) {
  const auto diagonal = [](Seen& seen, int) { seen.position_m = {80e-6, 80e-6, 0, 0}; };
  EXPECT_EQ(TripAfter(State::kLevitating, 3, diagonal).fault, Fault::kOrbitExceeded);
  const auto straight = [](Seen& seen, int) { seen.position_m = {80e-6, 0, 0, 80e-6}; };
  EXPECT_EQ(TripAfter(State::kLevitating, 3, straight).fault, Fault::kNone);
}

TEST(SensorRangeProtection, TripsAfterItsCyclesNearTheEndOfTheConverter) {
  const auto clipped = [](Seen& seen, int) { seen.position_m[1] = 399e-6; };
  // A spike trips nothing by itself: 2 cycles stay below every count.
  EXPECT_EQ(TripAfter(State::kLift, 3, clipped).fault, Fault::kNone);
  const Finding found = TripAfter(State::kLift, 4, clipped);
  EXPECT_EQ(found.fault, Fault::kSensorOutOfRange);
  EXPECT_EQ(found.axis, 1);
  EXPECT_DOUBLE_EQ(found.limit, 360e-6);
}

// de as every other rig here, nde twice as wide.
Driver OfUnevenBearings() {
  RigNumbers rig = TestRig();
  rig.clearances_m = {200e-6, 400e-6};
  rig.sensor_ranges_m = {400e-6, 800e-6};
  return Driver(rig);
}

Finding AfterCycles(Driver& driver, int cycles, const AxisArray& position_m) {
  for (int i = 0; i < cycles; ++i) {
    driver.seen.position_m = position_m;
    (void)driver.Step();
  }
  return driver.supervisor.decision().latch.finding;
}

TEST(UnevenBearings, EachOrbitIsHeldAgainstItsOwnClearance) {
  Driver driver = OfUnevenBearings();
  driver.GoTo(State::kSpinning);
  EXPECT_EQ(AfterCycles(driver, 3, {90e-6, 0, 190e-6, 0}).fault, Fault::kNone);
  const Finding wide = AfterCycles(driver, 3, {90e-6, 0, 210e-6, 0});
  EXPECT_EQ(wide.fault, Fault::kOrbitExceeded);
  EXPECT_EQ(wide.axis, 2);
  EXPECT_DOUBLE_EQ(wide.limit, 200e-6);
  Driver narrow = OfUnevenBearings();
  narrow.GoTo(State::kSpinning);
  const Finding found = AfterCycles(narrow, 3, {110e-6, 0, 190e-6, 0});
  EXPECT_EQ(found.axis, 0);
  EXPECT_DOUBLE_EQ(found.limit, 100e-6);
}

TEST(UnevenBearings, EachReadingIsHeldAgainstTheRangeOfItsOwnProbe) {
  Driver driver = OfUnevenBearings();
  driver.GoTo(State::kLift);
  EXPECT_EQ(AfterCycles(driver, 4, {0, 0, 0, 399e-6}).fault, Fault::kNone);
  Driver narrow = OfUnevenBearings();
  narrow.GoTo(State::kLift);
  EXPECT_EQ(AfterCycles(narrow, 4, {0, 399e-6, 0, 0}).fault, Fault::kSensorOutOfRange);
  Driver wide = OfUnevenBearings();
  wide.GoTo(State::kLift);
  const Finding found = AfterCycles(wide, 4, {0, 0, 0, 799e-6});
  EXPECT_EQ(found.fault, Fault::kSensorOutOfRange);
  EXPECT_DOUBLE_EQ(found.limit, 720e-6);
}

TEST(UnevenBearings, TheSelfTestLetsARotorLieInTheWiderBearing) {
  Driver driver = OfUnevenBearings();
  driver.GoTo(State::kSelfTest);
  EXPECT_EQ(AfterCycles(driver, 4, {240e-6, 0, 480e-6, 0}).fault, Fault::kNone);
  Driver beyond = OfUnevenBearings();
  beyond.GoTo(State::kSelfTest);
  const Finding found = AfterCycles(beyond, 4, {240e-6, 0, 510e-6, 0});
  EXPECT_EQ(found.fault, Fault::kSelfTestFailed);
  EXPECT_EQ(found.axis, 2);
  EXPECT_DOUBLE_EQ(found.limit, 500e-6);
}

TEST(FrozenProtection, TripsWhenOneAxisRepeatsItself) {
  const auto frozen = [](Seen& seen, int) { seen.frozen[2] = true; };
  // Six identical readings: the one before the sensor died is the first of them.
  EXPECT_EQ(TripAfter(State::kLevitating, 4, frozen).fault, Fault::kNone);
  const Finding found = TripAfter(State::kLevitating, 5, frozen);
  EXPECT_EQ(found.fault, Fault::kSensorFrozen);
  EXPECT_EQ(found.axis, 2);
  EXPECT_EQ(found.limit, 6.0);
}

TEST(NotFiniteProtection, TripsAtOnceForAPosition) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), HUGE_VAL, -HUGE_VAL}) {
    const Finding position =
        TripAfter(State::kSpinning, 1, [bad](Seen& seen, int) { seen.position_m[2] = bad; });
    EXPECT_EQ(position.fault, Fault::kSensorNotFinite);
    EXPECT_EQ(position.axis, 2);
    EXPECT_EQ(position.value, 0.0);  // comparable in a replay
  }
}

TEST(SaturationProtection, TripsWhenAnAxisStaysLimited) {
  const auto limited = [](Seen& seen, int) { seen.saturated_axes = 0b0100; };
  EXPECT_EQ(TripAfter(State::kLevitating, 7, limited).fault, Fault::kNone);
  const Finding found = TripAfter(State::kLevitating, 8, limited);
  EXPECT_EQ(found.fault, Fault::kCoilSaturated);
  EXPECT_EQ(found.axis, 2);
  EXPECT_NEAR(found.value, 8e-4, 1e-12);  // eight periods of 1e-4 s
  const auto in_turn = [](Seen& seen, int i) {
    seen.saturated_axes = static_cast<std::uint16_t>(1U << (i / 4 % 4));
  };
  EXPECT_EQ(TripAfter(State::kLevitating, 100, in_turn).fault, Fault::kNone);
}

TEST(OverSpeedProtection, TripsInEitherDirection) {
  const auto at = [](double speed) {
    return [speed](Seen& seen, int) { seen.speed_rad_per_s = speed; };
  };
  EXPECT_EQ(TripAfter(State::kSpinning, 5, at(659.9)).fault, Fault::kNone);
  EXPECT_EQ(TripAfter(State::kSpinning, 1, at(660.1)).fault, Fault::kOverSpeed);
  EXPECT_EQ(TripAfter(State::kCoastDown, 1, at(-660.1)).fault, Fault::kOverSpeed);
}

TEST(EmergencyStopProtection, DoesNotWaitForAFrame) {
  const auto open = [](Seen& seen, int) {
    seen.fresh = false;
    seen.rig_status = kRigEmergencyStop;
  };
  for (std::size_t i = 0; i <= static_cast<std::size_t>(State::kLanding); ++i) {
    EXPECT_EQ(TripAfter(static_cast<State>(i), 1, open).fault, Fault::kEmergencyStop);
  }
}

TEST(SpeedUnknownProtection, StopsALevitatedRotorAndIsNotLookedForInOff) {
  const auto lost = [](Seen& seen, int) { seen.rig_status = kRigSpeedUnknown; };
  for (const State state :
       {State::kLift, State::kLevitating, State::kSpinning, State::kCoastDown, State::kLanding}) {
    EXPECT_EQ(TripAfter(state, 1, lost).fault, Fault::kSpeedUnknown);
  }
  Driver driver;
  driver.seen.rig_status = kRigSpeedUnknown;
  EXPECT_EQ(driver.Step().latch.finding.fault, Fault::kNone);
  EXPECT_EQ(TripAfter(State::kSelfTest, 1, lost).fault, Fault::kSpeedUnknown);  // nothing is lifted
}

TEST(SpeedUnknownProtection, LeavesTheRotorLevitatedUnderTheBrake) {
  Driver driver;
  driver.GoTo(State::kSpinning);
  driver.seen.rig_status = kRigSpeedUnknown;
  const Decision& decision = driver.Step();
  EXPECT_EQ(decision.state, State::kTrippedStopping);
  EXPECT_TRUE(decision.drive_enabled);
  EXPECT_EQ(decision.speed_set_point_rad_per_s, 0.0);
}

TEST(EmergencyStopProtection, TakesTheRigsOwnChainInEveryStateBeforeATrip) {
  const auto open = [](Seen& seen, int) { seen.rig_status = kRigEmergencyStop; };
  for (std::size_t i = 0; i <= static_cast<std::size_t>(State::kLanding); ++i) {
    EXPECT_EQ(TripAfter(static_cast<State>(i), 1, open).fault, Fault::kEmergencyStop);
  }
}

TEST(RigRestartProtection, TripsWhenTheSessionChangesWhileInUse) {
  const auto restarted = [](Seen& seen, int) { seen.rig_session = 2; };
  EXPECT_EQ(TripAfter(State::kOff, 5, restarted).fault, Fault::kNone);
  const Finding found = TripAfter(State::kLevitating, 1, restarted);
  EXPECT_EQ(found.fault, Fault::kRigRestarted);
  EXPECT_EQ(found.value, 2.0);
  EXPECT_EQ(found.limit, 1.0);
}

TEST(AmplifierProtection, TripsForTheFaultBitAndForSilence) {
  const auto fault = [](Seen& seen, int) { seen.rig_status = kRigAmplifierFault; };
  EXPECT_EQ(TripAfter(State::kLevitating, 1, fault).fault, Fault::kAmplifierFault);
  const auto off = [](Seen& seen, int) { seen.rig_status = kRigAmplifiersOff; };
  const int answer = static_cast<int>(kAmplifierAnswerCycles);
  EXPECT_EQ(TripAfter(State::kLevitating, answer - 1, off).fault, Fault::kNone);
  EXPECT_EQ(TripAfter(State::kLevitating, answer, off).fault, Fault::kAmplifierFault);
  EXPECT_EQ(TripAfter(State::kOff, 10 * answer, off).fault, Fault::kNone);
}

TEST(Protections, PutSignalFaultsBeforeMotionFaults) {
  const auto both = [](Seen& seen, int) {
    seen.position_m[0] = std::numeric_limits<double>::quiet_NaN();
    seen.speed_rad_per_s = 1000.0;
  };
  EXPECT_EQ(TripAfter(State::kSpinning, 1, both).fault, Fault::kSensorNotFinite);
}

TEST(Protections, LatchTheCycleInWhichTheyTripped) {
  Driver driver;
  driver.GoTo(State::kSpinning);
  driver.seen.speed_rad_per_s = 1000.0;
  (void)driver.Step();
  const std::uint64_t cycle = driver.seen.cycle;
  (void)driver.Steps(10);
  EXPECT_EQ(driver.supervisor.decision().latch.cycle, cycle);
}

TEST(Protections, CannotBeSwitchedOffByAZero) {
  const auto throws = [](auto change) {
    ProtectionConfig config = TestConfig().protection;
    change(config);
    try {
      Protections protections(TestRig(), config);
    } catch (const std::invalid_argument&) {
      return true;
    }
    return false;
  };
  EXPECT_FALSE(throws([](ProtectionConfig&) {}));
  EXPECT_TRUE(throws([](ProtectionConfig& c) { c.orbit_fraction = 0.0; }));
  EXPECT_TRUE(throws([](ProtectionConfig& c) { c.orbit_cycles = 0; }));
  EXPECT_TRUE(throws([](ProtectionConfig& c) { c.sensor_range_fraction = HUGE_VAL; }));
  EXPECT_TRUE(throws([](ProtectionConfig& c) { c.sensor_range_cycles = 0; }));
  EXPECT_TRUE(throws([](ProtectionConfig& c) { c.sensor_frozen_cycles = 0; }));
  EXPECT_TRUE(throws([](ProtectionConfig& c) { c.frame_missing_cycles = 0; }));
  EXPECT_TRUE(throws([](ProtectionConfig& c) { c.frames_lost_cycles = 0; }));
  EXPECT_TRUE(throws([](ProtectionConfig& c) { c.frames_lost_window_cycles = 0; }));
  EXPECT_TRUE(throws([](ProtectionConfig& c) { c.currents_late_cycles = 0; }));
  EXPECT_TRUE(throws([](ProtectionConfig& c) { c.currents_late_window_cycles = 0; }));
  EXPECT_TRUE(throws([](ProtectionConfig& c) { c.deadline_missed_cycles = 0; }));
  EXPECT_TRUE(throws([](ProtectionConfig& c) { c.deadline_missed_cycles = 4'000'000'000U; }));
  EXPECT_TRUE(throws([](ProtectionConfig& c) { c.deadline_window_cycles = 0; }));
  EXPECT_TRUE(throws([](ProtectionConfig& c) { c.coil_saturated_s = -1.0; }));
  EXPECT_TRUE(throws([](ProtectionConfig& c) { c.over_speed_fraction = std::nan(""); }));
}

}  // namespace
}  // namespace levitas::supervisor

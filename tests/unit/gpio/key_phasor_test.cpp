// Speed and angle of good pulses: closed forms of a rotor under constant acceleration.
#include <gtest/gtest.h>

#include <algorithm>

#include "hil/gpio/key_phasor.hpp"
#include "tests/support/allocation_guard.hpp"
#include "tests/unit/gpio/rotor_marks.hpp"

namespace levitas::gpio {
namespace {

using namespace test;

double Apart(double a_rad, double b_rad) {
  const double apart = std::abs(a_rad - b_rad);
  return std::min(apart, kTurnRad - apart);
}

TEST(KeyPhasor, KnowsNothingAndStandsBeforeTheFirstPulse) {
  KeyPhasor key_phasor(Config());
  const SpeedReading reading = key_phasor.At(1'000'000'000);
  EXPECT_EQ(reading.state, SpeedState::kStanding);
  EXPECT_EQ(reading.speed_rad_per_s, 0.0);
}

TEST(KeyPhasor, LocksWithTheThirdOfThreePulsesThatAgree) {
  KeyPhasor key_phasor(Config());
  key_phasor.Pulse(0);
  EXPECT_EQ(key_phasor.At(0).state, SpeedState::kAcquiring);
  key_phasor.Pulse(kTurnNs);
  EXPECT_EQ(key_phasor.At(kTurnNs).state, SpeedState::kAcquiring);
  key_phasor.Pulse(2 * kTurnNs);
  EXPECT_EQ(key_phasor.At(2 * kTurnNs).state, SpeedState::kLocked);
}

TEST(KeyPhasor, MeasuresAConstantSpeedAndItsAngleAnywhereInTheTurn) {
  KeyPhasor key_phasor = Running();
  for (int part = 0; part < 10; ++part) {
    const SpeedReading reading = key_phasor.At(9 * kTurnNs + part * kTurnNs / 10);
    // Stamps are exact here; what is left is the rounding of doubles.
    EXPECT_NEAR(reading.speed_rad_per_s, kSpeed, 1e-9 * kSpeed);
    EXPECT_LT(Apart(reading.angle_rad, part * kTurnRad / 10), 1e-9);
  }
}

TEST(KeyPhasor, MeasuresAConstantAccelerationWithoutLag) {
  for (const double acceleration : {-200.0, -50.0, 50.0, 200.0}) {
    const Rotor rotor{kSpeed, acceleration};
    KeyPhasor key_phasor(Config());
    for (int k = 0; k < 12; ++k) key_phasor.Pulse(rotor.MarkNs(k));
    for (const double after_s : {0.0, 0.004, 0.012}) {
      const double time_s = rotor.MarkS(11) + after_s;
      const SpeedReading reading = key_phasor.At(std::llround(time_s * 1e9));
      EXPECT_EQ(reading.state, SpeedState::kLocked);
      // Half a nanosecond in each of three stamps 20 ms apart: 1e-7 of the speed, twice in a.
      EXPECT_NEAR(reading.speed_rad_per_s, rotor.SpeedAt(time_s), 4e-7 * kSpeed);
      EXPECT_LT(Apart(reading.angle_rad, rotor.AngleAt(time_s)), 4e-7 * kTurnRad);
    }
  }
}

TEST(KeyPhasor, TheLastIntervalAloneWouldLagBehindAnAcceleration) {
  const Rotor rotor{kSpeed, 200.0};
  const double naive = kTurnRad / (rotor.MarkS(11) - rotor.MarkS(10));
  // Half an interval of acceleration: what the estimate of the acceleration is for.
  EXPECT_GT(rotor.SpeedAt(rotor.MarkS(11)) - naive, 1.0);
}

TEST(KeyPhasor, FollowsAStartFromStandstill) {
  // No closed form at w = 0 by the formula above: t_k = sqrt(2 k d / a).
  constexpr double kA = 200.0;
  KeyPhasor key_phasor(Config());
  double time_s = 0.0;
  for (int k = 1; k < 40; ++k) {
    time_s = std::sqrt(2.0 * k * kTurnRad / kA);
    key_phasor.Pulse(std::llround(time_s * 1e9));
  }
  const SpeedReading reading = key_phasor.At(std::llround(time_s * 1e9));
  EXPECT_EQ(reading.state, SpeedState::kLocked);
  EXPECT_NEAR(reading.speed_rad_per_s, kA * time_s, 1e-5 * kA * time_s);
  EXPECT_EQ(
      key_phasor.counters().extra + key_phasor.counters().missing + key_phasor.counters().jumps,
      0U);
}

TEST(KeyPhasor, AnglesStartFromThatOfTheMark) {
  KeyPhasorConfig config = Config();
  config.angle_rad = -0.5;
  KeyPhasor key_phasor(config);
  for (int k = 0; k < 5; ++k) key_phasor.Pulse(k * kTurnNs);
  EXPECT_LT(Apart(key_phasor.At(4 * kTurnNs).angle_rad, kTurnRad - 0.5), 1e-9);
}

TEST(KeyPhasor, SeveralMarksGiveTheSameSpeedAndAFullTurnOfAngles) {
  constexpr int kMarks = 8;
  KeyPhasor key_phasor(Config(kMarks));
  for (int k = 0; k <= 4 * kMarks + 3; ++k) key_phasor.Pulse(k * kTurnNs / kMarks);
  const std::int64_t now_ns = (4 * kMarks + 3) * kTurnNs / kMarks;
  EXPECT_NEAR(key_phasor.At(now_ns).speed_rad_per_s, kSpeed, 1e-9 * kSpeed);
  // The third mark after the one that came first.
  const double first_rad = key_phasor.At(now_ns).angle_rad;
  EXPECT_NEAR(std::fmod(first_rad, kTurnRad / kMarks), 0.0, 1e-9);
  EXPECT_LT(Apart(key_phasor.At(now_ns + kTurnNs / 16).angle_rad, first_rad + kTurnRad / 16), 1e-9);
}

TEST(KeyPhasor, NoMarkForALongTimeMeansASlowRotorAndThenOneThatStands) {
  KeyPhasor key_phasor(Config());
  const Rotor rotor{20.0, 0.0};  // slow enough to stop within one turn at the allowed rate
  for (int k = 0; k < 6; ++k) key_phasor.Pulse(rotor.MarkNs(k));
  const std::int64_t last_ns = rotor.MarkNs(5);
  double previous = 20.0 * (1.0 + 1e-6);
  for (int tenth = 1; tenth < 1200; ++tenth) {
    const double elapsed_s = 0.1 * tenth;
    const SpeedReading reading = key_phasor.At(last_ns + tenth * 100'000'000LL);
    EXPECT_LE(reading.speed_rad_per_s, kTurnRad / elapsed_s * (1.0 + 1e-12));
    EXPECT_LE(reading.speed_rad_per_s, previous) << "a rotor without marks gains no speed";
    EXPECT_NE(reading.state, SpeedState::kUnknown);
    previous = reading.speed_rad_per_s;
  }
  const SpeedReading stands = key_phasor.At(last_ns + 130'000'000'000LL);
  EXPECT_EQ(stands.state, SpeedState::kStanding);
  EXPECT_EQ(stands.speed_rad_per_s, 0.0);
}

TEST(KeyPhasor, ASlowerRotorIsNotTakenForTurningBack) {
  // 40 rad/s at mark 3; it passes mark 4 and stops between marks 4 and 5.
  const Rotor before{std::sqrt(40.0 * 40.0 + 2.0 * 100.0 * 3.0 * kTurnRad), -100.0};
  KeyPhasor braking(Config());
  for (int k = 0; k < 5; ++k) braking.Pulse(before.MarkNs(k));
  double previous = 1e9;
  for (int ms = 0; ms < 3000; ++ms) {
    const SpeedReading reading = braking.At(before.MarkNs(4) + ms * 1'000'000LL);
    EXPECT_GE(reading.speed_rad_per_s, 0.0);
    EXPECT_LE(reading.speed_rad_per_s, previous + 1e-9);
    previous = reading.speed_rad_per_s;
  }
}

TEST(KeyPhasor, ACycleAllocatesNothing) {
  KeyPhasor key_phasor = Running();
  const levitas::test::AllocationGuard guard;
  double sum = 0.0;
  for (int k = 10; k < 1000; ++k) {
    key_phasor.Pulse(k * kTurnNs);
    sum += key_phasor.At(k * kTurnNs + 1).speed_rad_per_s;
  }
  EXPECT_EQ(guard.count(), 0U);
  EXPECT_GT(sum, 0.0);
}

}  // namespace
}  // namespace levitas::gpio

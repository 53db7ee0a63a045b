#include "controller/synchronous/angle_follower.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "common/random.hpp"
#include "tests/unit/synchronous/bench_numbers.hpp"

namespace levitas::synchronous {
namespace {

/// A shaft and what its sensor reads.
struct Shaft {
  double angle_rad{};
  double speed_rad_per_s{300.0};

  AngleReading Next(double acceleration_rad_per_s2 = 0.0) {
    angle_rad += speed_rad_per_s * kPeriodS + 0.5 * acceleration_rad_per_s2 * kPeriodS * kPeriodS;
    speed_rad_per_s += acceleration_rad_per_s2 * kPeriodS;
    angle_rad -= kTurn * std::floor(angle_rad / kTurn);
    return {true, false, angle_rad, speed_rad_per_s, 1};
  }
};

void Follow(AngleFollower& follower, Shaft& shaft, double time_s, double acceleration = 0.0) {
  for (int n = 0; n < static_cast<int>(time_s / kPeriodS); ++n) {
    follower.Update(shaft.Next(acceleration));
  }
}

/// Of the first order, wrapped to half a turn [rad].
double Behind(const AngleFollower& follower, const Shaft& shaft) {
  return std::remainder(shaft.angle_rad - kTurn * follower.TurnsOf(1.0), kTurn);
}

TEST(AngleFollower, IsGoodAfterTenTurnsAndThenHasNoLag) {
  AngleFollower follower({}, kPeriodS);
  Shaft shaft;
  const double ten_turns_s = AngleFollower::kGoodTurns * kTurn / shaft.speed_rad_per_s;
  Follow(follower, shaft, 0.98 * ten_turns_s);
  EXPECT_FALSE(follower.good());
  Follow(follower, shaft, 0.5);
  EXPECT_TRUE(follower.good());
  EXPECT_NEAR(Behind(follower, shaft), 0.0, 1e-6);
  EXPECT_NEAR(follower.speed_rad_per_s(), 300.0, 1e-6);
}

TEST(AngleFollower, LagsByTheAccelerationOverTheSquareOfItsBandwidth) {
  const AngleConfig config{.bandwidth_hz = 10.0};
  AngleFollower follower(config, kPeriodS);
  Shaft shaft;
  Follow(follower, shaft, 1.0);
  constexpr double kAcceleration = 80.0;
  Follow(follower, shaft, 1.0, kAcceleration);
  const double bandwidth = kTurn * config.bandwidth_hz;
  EXPECT_NEAR(Behind(follower, shaft), kAcceleration / (bandwidth * bandwidth), 3e-4);
}

TEST(AngleFollower, TakesOffTheNoiseOfAResolver) {
  AngleFollower follower({}, kPeriodS);
  Shaft shaft;
  double worst = 0.0;
  for (int n = 0; n < 20'000; ++n) {
    AngleReading reading = shaft.Next();
    reading.angle_rad += (n % 2 == 0 ? 0.02 : -0.02);
    follower.Update(reading);
    if (n > 10'000) worst = std::max(worst, std::abs(Behind(follower, shaft)));
  }
  EXPECT_LT(worst, 0.002);
}

TEST(AngleFollower, OneJumpEndsItAtOnceAndTheFlywheelKeepsTheOldPhase) {
  AngleFollower follower({}, kPeriodS);
  Shaft shaft;
  Follow(follower, shaft, 1.0);
  const Shaft before = shaft;
  shaft.angle_rad += 1.0;
  follower.Update(shaft.Next());
  EXPECT_EQ(follower.trouble(), AngleTrouble::kJumped);
  EXPECT_FALSE(follower.good());
  Shaft undisturbed = before;
  (void)undisturbed.Next();
  for (int n = 0; n < 100; ++n) {
    (void)undisturbed.Next();
    follower.Update(shaft.Next());
    EXPECT_NEAR(Behind(follower, undisturbed), 0.0, 1e-6);
  }
  Follow(follower, shaft, 1.0);
  EXPECT_TRUE(follower.good());
  EXPECT_NEAR(Behind(follower, shaft), 0.0, 1e-3) << "the new angle is followed in the end";
}

TEST(AngleFollower, AnAngleThatStandsWhileTheRotorTurnsHasJumpedWithinATurn) {
  AngleFollower follower({}, kPeriodS);
  Shaft shaft;
  Follow(follower, shaft, 1.0);
  AngleReading stuck = shaft.Next();
  const int turn = static_cast<int>(kTurn / shaft.speed_rad_per_s / kPeriodS);
  bool ended = false;
  for (int n = 0; n < turn && !ended; ++n) {
    follower.Update(stuck);
    ended = !follower.good();
  }
  EXPECT_TRUE(ended);
}

TEST(AngleFollower, WithoutAReadingForHalfATurnItIsLost) {
  AngleFollower follower({}, kPeriodS);
  Shaft shaft;
  Follow(follower, shaft, 1.0);
  const int turn = static_cast<int>(kTurn / shaft.speed_rad_per_s / kPeriodS);
  int n = 0;
  while (follower.good() && n < 2 * turn) {
    (void)shaft.Next();
    follower.Update({.fresh = false});
    ++n;
  }
  EXPECT_NEAR(n, turn / 2, 2);
}

TEST(AngleFollower, ASpeedThatIsNotTheAnglesIsNotBelieved) {
  AngleFollower follower({}, kPeriodS);
  Shaft shaft;
  Follow(follower, shaft, 1.0);
  AngleReading other = shaft.Next();
  other.speed_rad_per_s = 400.0;
  follower.Update(other);
  EXPECT_FALSE(follower.good());
}

TEST(AngleFollower, WhatIsNoNumberOrUnknownIsLost) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  for (const AngleReading& bad :
       {AngleReading{true, false, none, 300.0, 1}, AngleReading{true, false, 1.0, none, 1},
        AngleReading{true, true, 1.0, 300.0, 1}}) {
    AngleFollower follower({}, kPeriodS);
    Shaft shaft;
    Follow(follower, shaft, 1.0);
    follower.Update(bad);
    EXPECT_EQ(follower.trouble(), AngleTrouble::kLost);
    EXPECT_TRUE(std::isfinite(follower.TurnsOf(3.0)));
  }
}

TEST(AngleFollower, PeriodsThatWereSkippedAreCounted) {
  AngleFollower follower({}, kPeriodS);
  Shaft shaft;
  Follow(follower, shaft, 1.0);
  for (int n = 0; n < 20; ++n) (void)shaft.Next();
  AngleReading late = shaft.Next();
  late.periods = 21;
  follower.Update(late);
  EXPECT_TRUE(follower.good());
  EXPECT_NEAR(Behind(follower, shaft), 0.0, 1e-6);
}

TEST(AngleFollower, AnOrderThatIsNoWholeNumberHasNoStepWhereTheAngleWraps) {
  AngleFollower follower({}, kPeriodS);
  Shaft shaft;
  Follow(follower, shaft, 1.0);
  const double order = 20.0 / 41.0;
  double before = follower.TurnsOf(order);
  for (int n = 0; n < 5000; ++n) {
    follower.Update(shaft.Next());
    const double now = follower.TurnsOf(order);
    const double step = now - before - std::floor(now - before + 0.5);
    EXPECT_NEAR(step, order * shaft.speed_rad_per_s * kPeriodS / kTurn, 1e-7);
    before = now;
  }
}

TEST(AngleFollower, FromTheSpeedAloneAJumpOfTheAngleIsNotSeen) {
  AngleFollower follower({.source = AngleSource::kSpeed}, kPeriodS);
  Shaft shaft;
  Follow(follower, shaft, 1.0);
  EXPECT_TRUE(follower.good());
  const double before = follower.TurnsOf(1.0);
  shaft.angle_rad += 2.0;
  follower.Update(shaft.Next());
  EXPECT_TRUE(follower.good());
  const double step = follower.TurnsOf(1.0) - before;
  EXPECT_NEAR(step - std::floor(step + 0.5), 300.0 * kPeriodS / kTurn, 1e-9);
}

/// A rotor without a mark: the rig's speed is `told` times the true one, and its orbit turns
/// forward beside what stands still and what turns backward, in two bearings of opposite phase.
struct Unmarked {
  Shaft shaft;
  double told{1.0};
  double forward_m{10e-6};
  double ahead_rad{};  ///< of the orbit before the rotor
  Random noise{7};

  void Follow(AngleFollower& follower, double time_s, double acceleration = 0.0) {
    for (int n = 0; n < static_cast<int>(time_s / kPeriodS); ++n) {
      AngleReading reading = shaft.Next(acceleration);
      const double forward_rad = reading.angle_rad + ahead_rad;
      const double backward_rad = -reading.angle_rad;
      AxisArray position_m{};
      for (std::size_t b = 0; b < 2; ++b) {
        const double size_m = b == 0 ? forward_m : -0.7 * forward_m;
        position_m[2 * b] = 30e-6 + size_m * std::cos(forward_rad) + 4e-6 * std::cos(backward_rad);
        position_m[2 * b + 1] =
            -9e-6 + size_m * std::sin(forward_rad) + 4e-6 * std::sin(backward_rad);
        for (std::size_t i = 2 * b; i < 2 * b + 2; ++i) position_m[i] += 1e-6 * noise.Normal();
      }
      reading.angle_rad = 0.0;  // nothing measures it
      reading.speed_rad_per_s *= told;
      follower.Update(reading, position_m);
    }
  }
  /// Of the followed speed.
  [[nodiscard]] double Off(const AngleFollower& follower) const {
    return follower.speed_rad_per_s() / shaft.speed_rad_per_s - 1.0;
  }
};

AngleFollower OfOrbit() { return {{.source = AngleSource::kOrbit}, kPeriodS, 4}; }

TEST(AngleFollower, FromTheOrbitASpeedThatIsToldWrongIsMended) {
  for (const double told : {0.92, 0.98, 1.0, 1.03, 1.07}) {
    AngleFollower follower = OfOrbit();
    Unmarked rotor;
    rotor.told = told;
    rotor.Follow(follower, 3.0);
    EXPECT_TRUE(follower.good());
    EXPECT_LT(std::abs(rotor.Off(follower)), 1e-3) << told;
    const double before = Behind(follower, rotor.shaft);
    rotor.Follow(follower, 2.0);
    EXPECT_NEAR(Behind(follower, rotor.shaft), before, 0.05) << told << ", rad: three degrees";
  }
}

TEST(AngleFollower, FromTheOrbitARunUpIsFollowedWithItsSlip) {
  AngleFollower follower = OfOrbit();
  Unmarked rotor;
  rotor.told = 0.97;
  rotor.Follow(follower, 2.0);
  rotor.Follow(follower, 3.0, 80.0);
  EXPECT_TRUE(follower.good());
  EXPECT_LT(std::abs(rotor.Off(follower)), 2e-3);
}

TEST(AngleFollower, AnOrbitTooSmallToBeFollowedIsLostAndNeverGood) {
  AngleFollower follower = OfOrbit();
  Unmarked rotor;
  rotor.Follow(follower, 2.0);
  ASSERT_TRUE(follower.good());
  rotor.forward_m = 0.3e-6;  // a quarter of 2 um and less
  bool lost = false;
  for (int n = 0; n < 420 && !lost; ++n) {  // two turns: one may have begun before
    rotor.Follow(follower, 1.01 * kPeriodS);
    lost = follower.trouble() == AngleTrouble::kLost;
  }
  EXPECT_TRUE(lost);
  rotor.Follow(follower, 3.0);
  EXPECT_FALSE(follower.good());
}

TEST(AngleFollower, AnOrbitThatJumpsIsNoAngle) {
  AngleFollower follower = OfOrbit();
  Unmarked rotor;
  rotor.Follow(follower, 2.0);
  ASSERT_TRUE(follower.good());
  rotor.ahead_rad = 2.0;
  bool jumped = false;
  for (int n = 0; n < 630 && !jumped; ++n) {
    rotor.Follow(follower, 1.01 * kPeriodS);
    jumped = follower.trouble() == AngleTrouble::kJumped;
  }
  EXPECT_TRUE(jumped);
}

TEST(AngleFollower, ASlipWithinWhatIsAllowedIsFollowedAndOneBeyondIsNot) {
  for (const double told : {0.93, 0.88}) {
    AngleFollower follower = OfOrbit();
    Unmarked rotor;
    rotor.told = told;
    rotor.Follow(follower, 3.0);
    EXPECT_EQ(follower.good(), 1.0 / told - 1.0 < 0.1) << told;
  }
}

/// A block that fades says nothing of the rotor: at 30 000 rpm thirty turns pass within it.
TEST(AngleFollower, ACoastDoesNotMakeAnAngleGood) {
  AngleFollower follower = OfOrbit();
  Unmarked rotor;
  rotor.told = 0.95;
  rotor.shaft.speed_rad_per_s = 3141.6;
  rotor.Follow(follower, 0.01);
  follower.Coast(0.2);
  rotor.Follow(follower, 0.19);
  EXPECT_FALSE(follower.good());
  rotor.Follow(follower, 1.0);
  EXPECT_TRUE(follower.good());
  EXPECT_LT(std::abs(rotor.Off(follower)), 2e-3);
}

TEST(AngleFollower, APositionThatIsNoNumberLosesTheOrbitWithinItsTurn) {
  AngleFollower follower = OfOrbit();
  Unmarked rotor;
  rotor.Follow(follower, 2.0);
  ASSERT_TRUE(follower.good());
  AngleReading reading = rotor.shaft.Next();
  AxisArray position_m{};
  position_m[0] = std::numeric_limits<double>::quiet_NaN();
  follower.Update(reading, position_m);
  bool lost = false;
  for (int n = 0; n < 210 && !lost; ++n) {
    rotor.Follow(follower, 1.01 * kPeriodS);
    lost = follower.trouble() == AngleTrouble::kLost;
  }
  EXPECT_TRUE(lost);
}

/// Every turn has a hole at the same place: a standing offset would be taken for an orbit.
TEST(AngleFollower, TurnsWithMissingFramesAreLeftOutUntilTheAngleIsLost) {
  AngleFollower follower = OfOrbit();
  Unmarked rotor;
  rotor.Follow(follower, 2.0);
  ASSERT_TRUE(follower.good());
  const auto with_holes = [&](int turns) {
    for (int turn = 0; turn < turns; ++turn) {
      rotor.Follow(follower, 160.5 * kPeriodS);
      for (int n = 0; n < 49; ++n) {
        (void)rotor.shaft.Next();
        follower.Update({.fresh = false});
      }
    }
  };
  with_holes(4);
  EXPECT_TRUE(follower.good()) << "a few are borne";
  EXPECT_LT(std::abs(rotor.Off(follower)), 1e-3);
  with_holes(20);
  EXPECT_FALSE(follower.good());
}

}  // namespace
}  // namespace levitas::synchronous

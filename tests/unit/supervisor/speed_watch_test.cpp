// What of the speed is believed, and what proves that the rotor stands or turns: just below each
// limit and at it.

#include "controller/supervisor/speed_watch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "common/random.hpp"
#include "tests/unit/supervisor/supervisor_rig.hpp"

namespace levitas::supervisor {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// A rig of 10 kHz and 600 rad/s whose drive changes the speed by 0.02 rad/s in a period (200
/// rad/s2). Believed within a period: 1 % of 600 rad/s and twice 0.02 rad/s, 6.04 rad/s.
class Watched {
 public:
  Watched() : watch_(Rig(), Config()) {}

  Watched& See(double speed_rad_per_s, int cycles = 1) {
    for (int i = 0; i < cycles; ++i) {
      seen_.speed_rad_per_s = speed_rad_per_s;
      watch_.Update(seen_.Next(), brake_rad_per_s2);
    }
    return *this;
  }
  Watched& Miss(int cycles) {
    seen_.fresh = false;
    See(seen_.speed_rad_per_s, cycles);
    seen_.fresh = true;
    return *this;
  }
  Watched& Reported(double speed_rad_per_s, int cycles) {
    seen_.rig_status = kRigSpeedUnknown;
    See(speed_rad_per_s, cycles);
    seen_.rig_status = 0;
    return *this;
  }
  SpeedWatch& operator*() { return watch_; }
  SpeedWatch* operator->() { return &watch_; }

  double brake_rad_per_s2{};

 private:
  static RigNumbers Rig() {
    RigNumbers rig = TestRig();
    rig.max_acceleration_rad_per_s2 = 200.0;
    return rig;
  }
  static SequenceConfig Config() {
    SequenceConfig config = TestConfig().sequence;
    config.standstill_s = 0.2;
    return config;
  }

  Seen seen_;
  SpeedWatch watch_;
};

TEST(SpeedWatch, KnowsNothingBeforeTheFirstFrame) {
  Watched rotor;
  rotor.Miss(5000);
  EXPECT_FALSE(rotor->stands());
  EXPECT_FALSE(rotor->may_turn());
  EXPECT_FALSE(rotor->unknown());
}

TEST(SpeedWatch, ProvesStandstillByItsTimeWithoutInterruption) {
  Watched rotor;
  rotor.See(0.99, 1999);
  EXPECT_FALSE(rotor->stands());
  EXPECT_TRUE(rotor.See(-0.99)->stands());
  EXPECT_FALSE(rotor.See(1.0)->stands());  // the limit itself turns
  EXPECT_FALSE(rotor.See(0.0, 1999)->stands());
  EXPECT_TRUE(rotor.See(0.0)->stands());
}

TEST(SpeedWatch, CountsAGapOfFramesForNoMoreThanTenPeriods) {
  Watched rotor;
  rotor.See(0.0).Miss(5000).See(0.0);
  EXPECT_FALSE(rotor->stands());
  Watched sparse;  // every tenth frame proves it in the same time
  for (int i = 0; i < 199; ++i) sparse.See(0.0).Miss(9);
  EXPECT_FALSE(sparse->stands());
  EXPECT_TRUE(sparse.See(0.0).Miss(9).See(0.0)->stands());
}

TEST(SpeedWatch, ProvesThatItTurnsByTwentyMilliseconds) {
  Watched rotor;
  rotor.See(0.0, 3000);
  EXPECT_FALSE(rotor.See(2.0, 199)->turns());
  EXPECT_TRUE(rotor->may_turn());
  EXPECT_TRUE(rotor.See(2.0)->turns());
}

TEST(SpeedWatch, FollowsADriveThatDoesAllItCan) {
  Watched rotor;
  double speed_rad_per_s = 0.0;
  for (int i = 0; i < 30'000; ++i) {
    rotor.See(speed_rad_per_s += 0.02);
    ASSERT_EQ(rotor->Magnitude(), speed_rad_per_s) << i;
  }
  while (speed_rad_per_s > 0.0) {
    rotor.See(speed_rad_per_s -= 0.02);
    ASSERT_EQ(rotor->Magnitude(), std::abs(speed_rad_per_s));
  }
  EXPECT_FALSE(rotor->stands());
}

TEST(SpeedWatch, BelievesNoSingleReadingThatTheDriveCannotHaveMade) {
  for (const double glitch : {0.0, -2.0, 600.0, -300.0, 293.9, kNan, HUGE_VAL, -HUGE_VAL, 1e308}) {
    Watched rotor;
    rotor.See(300.0, 100).See(glitch);
    EXPECT_EQ(rotor->Magnitude(), 300.0) << glitch;
    EXPECT_FALSE(rotor->unknown());
    rotor.See(300.0);
    for (int i = 0; i < 1000; ++i) rotor.See(glitch, 50).See(300.0);
    EXPECT_FALSE(rotor->unknown()) << "each time confirmed: " << glitch;
    EXPECT_FALSE(rotor->stands());
  }
  Watched near;
  near.See(300.0).See(294.0);
  EXPECT_EQ(near->Magnitude(), 294.0);
}

// 1.5 turns at 300 rad/s are 31.4 ms.
TEST(SpeedWatch, GivesUpWhenReadingsContradictForOneAndAHalfTurns) {
  for (const double glitch : {0.0, 600.0, kNan, HUGE_VAL}) {
    Watched rotor;
    rotor.See(300.0, 100).See(glitch, 314);
    EXPECT_FALSE(rotor->unknown()) << glitch;
    rotor.See(glitch);
    EXPECT_TRUE(rotor->unknown()) << glitch;
    EXPECT_TRUE(rotor->turns());
    EXPECT_FALSE(rotor->stands());
    EXPECT_EQ(rotor->Contradiction().fault, Fault::kSpeedUnknown);
    EXPECT_EQ(rotor->Contradiction().value, std::isfinite(glitch) ? glitch : 0.0);
    // 300 rad/s less, or plus, 6 rad/s and 400 rad/s2 x 31.5 ms.
    EXPECT_NEAR(rotor->Contradiction().limit, glitch == 600.0 ? 318.6 : 281.4, 1e-9);
  }
}

TEST(SpeedWatch, WaitsForTenMillisecondsAtLeastAndForAFifthOfASecondAtMost) {
  Watched fast;
  EXPECT_FALSE(fast.See(600.0, 2).See(0.0, 157)->unknown());  // 1.5 turns are 15.7 ms
  EXPECT_TRUE(fast.See(0.0)->unknown());
  Watched slow;
  EXPECT_FALSE(slow.See(0.5, 9).See(kNan, 1999)->unknown());
  EXPECT_TRUE(slow.See(kNan)->unknown());
}

// The first pulses of a key phasor: a speed that had stood at zero for long jumps to what the drive
// has made of it meanwhile. One that cannot be is not believed.
TEST(SpeedWatch, BelievesALateRiseThatTheDriveCanHaveMade) {
  Watched rotor;  // 200 rad/s take (200 - 6)/400 = 0.485 s, of which 0.4 s lie before the jump
  rotor.See(0.0, 4000).See(200.0, 1999);
  EXPECT_EQ(rotor->Magnitude(), 0.0);
  EXPECT_EQ(rotor.See(200.0)->Magnitude(), 200.0);
  EXPECT_FALSE(rotor->unknown());
  Watched other;
  other.See(0.0, 3000).See(300.0, 2000);  // 0.5 s would do for 200 rad/s
  EXPECT_TRUE(other->unknown());
}

// A reading stuck at zero: the brake takes 1.5 x 294 rad/s / 100 rad/s2 to bring the rotor below
// what is believed, then 0.2 s of agreement and 0.2 s of standstill prove it.
TEST(SpeedWatch, BelievesAStuckZeroOnlyWhenTheBrakeMustHaveStoppedTheRotor) {
  Watched rotor;
  rotor.See(300.0, 100).See(0.0, 315);
  ASSERT_TRUE(rotor->unknown());
  rotor.See(0.0, 60'000);
  EXPECT_TRUE(rotor->unknown()) << "nobody brakes";
  rotor.brake_rad_per_s2 = 100.0;
  rotor.See(0.0, 44'000);
  EXPECT_TRUE(rotor->unknown());
  rotor.See(0.0, 2200);
  EXPECT_FALSE(rotor->unknown());
  EXPECT_FALSE(rotor->stands());
  EXPECT_TRUE(rotor.See(0.0, 2000)->stands());
}

TEST(SpeedWatch, CountsABrakeForNoMoreThanTheDriveCan) {
  Watched rotor;
  rotor.See(300.0, 100).See(0.0, 315);
  rotor.brake_rad_per_s2 = 1e6;
  rotor.See(0.0, 22'000);  // 294 rad/s / (200 / 1.5 rad/s2) = 2.2 s
  EXPECT_TRUE(rotor->unknown());
  EXPECT_FALSE(rotor.See(0.0, 2200)->unknown());
}

TEST(SpeedWatch, RegainsASpeedThatAgreesWithItselfForLongEnough) {
  Watched rotor;
  rotor.See(300.0, 100).See(kNan, 400);
  ASSERT_TRUE(rotor->unknown());
  for (int i = 0; i < 3000; ++i) rotor.See(i % 100 == 0 ? kNan : 300.0);
  EXPECT_TRUE(rotor->unknown());
  EXPECT_FALSE(rotor.See(300.0, 2002)->unknown());
  EXPECT_EQ(rotor->Magnitude(), 300.0);
  EXPECT_FALSE(rotor->stands());
}

TEST(SpeedWatch, ProvesNothingWhileTheRigDoesNotKnowTheSpeed) {
  Watched rotor;
  rotor.See(0.0, 1999).Reported(0.0, 1000);
  EXPECT_FALSE(rotor->stands());
  EXPECT_FALSE(rotor.See(0.0, 1999)->stands());
  EXPECT_TRUE(rotor.See(0.0)->stands());
  Watched held;  // the key phasor holds the last good one and finds a slower rotor afterwards
  held.See(300.0, 100).Reported(300.0, 10'000).See(100.0);
  EXPECT_EQ(held->Magnitude(), 100.0);
  EXPECT_FALSE(held->unknown());
}

TEST(SpeedWatch, ForgetsTheRotorOfAnotherRig) {
  Watched rotor;
  rotor.See(300.0, 100).See(kNan, 1000);
  ASSERT_TRUE(rotor->unknown());
  rotor->Forget();
  EXPECT_FALSE(rotor->unknown());
  EXPECT_FALSE(rotor->may_turn());
  EXPECT_FALSE(rotor.See(0.0, 1999)->stands());
  EXPECT_TRUE(rotor.See(0.0)->stands());
}

// A rotor that runs down at the drive's rate while its speed is misread in every way: whatever is
// read, it is never said to stand while it turns at more than a tenth of the rated speed.
TEST(SpeedWatch, NeverCallsATurningRotorStanding) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Random draw(seed);
    Watched rotor;
    double speed_rad_per_s = 600.0;
    rotor.See(speed_rad_per_s, 10);
    rotor.brake_rad_per_s2 = 200.0;
    double wrong = 0.0;
    int left = 0;
    while (speed_rad_per_s > 60.0) {
      speed_rad_per_s -= 0.02;
      if (left == 0 && draw.Bits() % 300 == 0) {
        left = 1 + static_cast<int>(draw.Bits() % (draw.Bits() % 4 == 0 ? 30'000 : 400));
        wrong = draw.Bits() % 3 == 0 ? kNan : draw.Bits() % 2 == 0 ? 0.0 : 600.0 * draw.Uniform();
      }
      if (left > 0) --left;
      rotor.See(left > 0 ? wrong : speed_rad_per_s);
      ASSERT_FALSE(rotor->stands()) << "seed " << seed << " at " << speed_rad_per_s << " rad/s";
    }
  }
}

}  // namespace
}  // namespace levitas::supervisor

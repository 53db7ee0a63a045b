#include "plant_sim/amplifier/amplifier.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/random.hpp"

namespace levitas::amplifier {
namespace {

constexpr double kTau_s = 1.0 / (2.0 * std::numbers::pi * 720.0);

TEST(LimitedCommand, KeepsBothCoilsBetweenZeroAndTheMaximumForAnyInput) {
  Random random(20261121);
  const Limits limits{2.0, 0.0};
  for (int i = 0; i < 10'000; ++i) {
    const double control_a = 10.0 * (random.Uniform() - 0.5);
    const double bias_a = 6.0 * (random.Uniform() - 0.25);
    const CoilPair pair = LimitedCommand(limits, true, control_a, bias_a);
    EXPECT_GE(pair.bias_a - std::abs(pair.control_a), 0.0);
    EXPECT_LE(pair.bias_a + std::abs(pair.control_a), 2.0);
  }
}

TEST(LimitedCommand, LeavesACommandAloneThatIsInRange) {
  const CoilPair pair = LimitedCommand({2.0, 0.0}, true, 0.75, 1.0);
  EXPECT_DOUBLE_EQ(pair.control_a, 0.75);
  EXPECT_DOUBLE_EQ(pair.bias_a, 1.0);
}

TEST(LimitedCommand, LosesForceOnlyInTheCoilThatIsAtItsLimit) {
  // i+ = 2.5 is cut to 2, i- = -0.5 to 0: the pair becomes bias 1, control 1.
  const CoilPair pair = LimitedCommand({2.0, 0.0}, true, 1.5, 1.0);
  EXPECT_DOUBLE_EQ(pair.control_a, 1.0);
  EXPECT_DOUBLE_EQ(pair.bias_a, 1.0);
  // Bias 0.25 and control 1: i+ = 1.25 stays, i- = -0.75 becomes 0.
  const CoilPair low = LimitedCommand({2.0, 0.0}, true, 1.0, 0.25);
  EXPECT_DOUBLE_EQ(low.bias_a + low.control_a, 1.25);
  EXPECT_DOUBLE_EQ(low.bias_a - low.control_a, 0.0);
}

TEST(LimitedCommand, AsksBothCoilsForNothingWhenSwitchedOff) {
  const CoilPair pair = LimitedCommand({2.0, 0.0}, false, 0.5, 1.0);
  EXPECT_EQ(pair.control_a, 0.0);
  EXPECT_EQ(pair.bias_a, 0.0);
}

TEST(LimitedCommand, RoundsTheControlCurrentToTheNearestStepOfTheConverter) {
  const double step_a = ConverterStep(2.0, 12);
  EXPECT_DOUBLE_EQ(step_a, 4.0 / 4096.0);
  for (const double control_a : {0.1, -0.337, 0.00049}) {
    const double given_a = LimitedCommand({2.0, step_a}, true, control_a, 1.0).control_a;
    EXPECT_NEAR(std::remainder(given_a, step_a), 0.0, 1e-12);
    EXPECT_LE(std::abs(given_a - control_a), step_a / 2.0 + 1e-12);
  }
  EXPECT_EQ(ConverterStep(2.0, 0), 0.0);
}

TEST(Follow, IsTheFirstOrderResponse) {
  const Step step = MakeStep(720.0, 0.0, 50e-6);
  double control_a = 0.2;
  double bias_a = 0.0;
  for (int i = 0; i < 10; ++i) Follow(step, {-0.4, 1.0}, control_a, bias_a);
  const double decay = std::exp(-500e-6 / kTau_s);
  EXPECT_NEAR(control_a, -0.4 + 0.6 * decay, 1e-14);  // rounding of ten products
  EXPECT_NEAR(bias_a, 1.0 - decay, 1e-14);
}

TEST(FollowSlewing, EqualsALinearAmplifierWhenTheErrorIsSmall) {
  const Step step = MakeStep(720.0, 1000.0, 50e-6);
  const double now_a = 0.1;
  const double command_a = now_a + 0.9 * 1000.0 * kTau_s;
  EXPECT_NEAR(FollowSlewing(step, now_a, command_a),
              command_a + (now_a - command_a) * std::exp(-50e-6 / kTau_s), 1e-14);
}

TEST(FollowSlewing, RunsAtTheSlewRateAndThenSettlesAsTheFineIntegrationDoes) {
  const double slew = 1000.0;
  for (const double command_a : {1.0, -1.0}) {
    double fine_a = 0.0;
    constexpr double kStep_s = 1e-8;
    for (int i = 0; i < 200'000; ++i) {  // Euler with the limit, 2 ms
      const double rate = std::clamp((command_a - fine_a) / kTau_s, -slew, slew);
      fine_a += rate * kStep_s;
    }
    double now_a = 0.0;
    const Step step = MakeStep(720.0, slew, 100e-6);
    for (int i = 0; i < 20; ++i) {
      const double before_a = now_a;
      now_a = FollowSlewing(step, now_a, command_a);
      EXPECT_LE(std::abs(now_a - before_a), slew * 100e-6 * (1.0 + 1e-12));
    }
    EXPECT_NEAR(now_a, fine_a, 1e-5);  // Euler's error: kStep_s / tau of the remaining current
  }
}

TEST(Follow, LimitsTheSlewOfEachCoilAndNeverDrivesOneBelowZero) {
  // From nothing to i+ = 2, i- = 0: only one coil moves, so control and bias rise together.
  const Step step = MakeStep(720.0, 1000.0, 100e-6);
  double control_a = 0.0;
  double bias_a = 0.0;
  Follow(step, {1.0, 1.0}, control_a, bias_a);
  EXPECT_NEAR(bias_a + control_a, 0.1, 1e-12);  // slew times step
  EXPECT_NEAR(bias_a - control_a, 0.0, 1e-15);
}

}  // namespace
}  // namespace levitas::amplifier

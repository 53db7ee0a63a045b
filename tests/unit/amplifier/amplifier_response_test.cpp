// The amplifier in time and frequency against closed forms, over random currents and limits.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "common/random.hpp"
#include "plant_sim/amplifier/amplifier.hpp"

namespace levitas::amplifier {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;

struct Draw {
  explicit Draw(Random& random) {
    const auto between = [&random](double a, double b) { return a + (b - a) * random.Uniform(); };
    bandwidth_hz = std::pow(10.0, between(1.5, 4.0));
    slew_a_per_s = std::pow(10.0, between(2.0, 5.0));
    duration_s = std::pow(10.0, between(-5.5, -3.0));
    now_a = between(0.0, 5.0);
    command_a = between(0.0, 5.0);
  }
  [[nodiscard]] double After() const {
    return FollowSlewing(MakeStep(bandwidth_hz, slew_a_per_s, duration_s), now_a, command_a);
  }
  double bandwidth_hz, slew_a_per_s, duration_s, now_a, command_a;
};

TEST(Follow, HasTheFrequencyResponseOfAHeldCommandThroughTheFirstOrder) {
  // Zero-order hold and 1/(1 + s tau), sampled: (1 - d)/(z - d), d = e^{-h/tau}. Followed in time
  // until the start has died away, then compared sample by sample.
  const Step step = MakeStep(720.0, 0.0, 100e-6);
  const double decay = std::exp(-kTwoPi * 720.0 * 100e-6);
  for (const double frequency_hz : {5.0, 100.0, 720.0, 3000.0}) {
    const std::complex<double> turn = std::polar(1.0, kTwoPi * frequency_hz * 100e-6);
    const std::complex<double> response = (1.0 - decay) / (turn - decay);
    double control_a = 0.0;
    double bias_a = 1.0;
    std::complex<double> phase = 1.0;
    for (int i = 0; i < 400; ++i) {
      // After 100 samples e^{-45} of the start is left.
      if (i > 100) {
        EXPECT_NEAR(control_a, (response * phase).imag(), 1e-12) << frequency_hz;
      }
      Follow(step, {phase.imag(), 1.0}, control_a, bias_a);
      phase *= turn;
    }
    EXPECT_DOUBLE_EQ(bias_a, 1.0);
  }
}

TEST(FollowSlewing, GivesTheSameInOneStepAsInMany) {
  Random random(31);
  for (int i = 0; i < 5000; ++i) {
    Draw draw(random);
    const double whole_a = draw.After();
    const auto pieces = static_cast<int>(2 + random.Bits() % 20);
    draw.duration_s /= pieces;
    for (int piece = 0; piece < pieces; ++piece) draw.now_a = draw.After();
    EXPECT_NEAR(draw.now_a, whole_a, 1e-12) << i;  // twenty roundings of 5 A
  }
}

TEST(FollowSlewing, NeverOvershootsNeverExceedsTheSlewRateAndNeverTurnsBack) {
  Random random(32);
  for (int i = 0; i < 20'000; ++i) {
    const Draw draw(random);
    const double after_a = draw.After();
    const double gone_a = std::abs(after_a - draw.now_a);
    EXPECT_LE(gone_a, draw.slew_a_per_s * draw.duration_s * (1.0 + 1e-9) + 1e-15) << i;  // rounding
    EXPECT_LE(after_a, std::max(draw.now_a, draw.command_a) + 1e-15) << i;
    EXPECT_GE(after_a, std::min(draw.now_a, draw.command_a) - 1e-15) << i;
  }
}

TEST(FollowSlewing, IsNeverFasterThanWithoutTheLimitAndEqualsItWhenTheLimitIsHigh) {
  Random random(33);
  for (int i = 0; i < 20'000; ++i) {
    Draw draw(random);
    const double decay = std::exp(-kTwoPi * draw.bandwidth_hz * draw.duration_s);
    const double linear_a = draw.command_a + (draw.now_a - draw.command_a) * decay;
    const double error_a = std::abs(draw.command_a - draw.After());
    EXPECT_GE(error_a, std::abs(draw.command_a - linear_a) - 1e-14) << i;  // rounding
    draw.slew_a_per_s = 1e9;  // above 5 A / tau = 3e5 A/s
    EXPECT_NEAR(draw.After(), linear_a, 1e-14) << i;
  }
}

TEST(FollowSlewing, KeepsTheOrderOfTwoCurrentsAndOfTwoCommands) {
  Random random(34);
  for (int i = 0; i < 20'000; ++i) {
    const Draw draw(random);
    Draw higher = draw;
    higher.now_a += random.Uniform();
    EXPECT_GE(higher.After(), draw.After() - 1e-14) << i;  // rounding
    Draw asked = draw;
    asked.command_a += random.Uniform();
    EXPECT_GE(asked.After(), draw.After() - 1e-14) << i;
  }
}

TEST(FollowSlewing, FallsAsItRises) {
  Random random(35);
  for (int i = 0; i < 5000; ++i) {
    const Draw draw(random);
    Draw mirrored = draw;
    mirrored.now_a = -draw.now_a;
    mirrored.command_a = -draw.command_a;
    EXPECT_EQ(mirrored.After(), -draw.After()) << i;
  }
}

TEST(FollowSlewing, ReachesTheLinearRegionAfterTheTimeOfTheClosedForm) {
  // From 0 to I at S: the error falls to S tau after (I - S tau)/S, then decays with tau.
  constexpr double kSlew_a_per_s = 2000.0;
  constexpr double kCommand_a = 2.0;
  const double tau_s = 1.0 / (kTwoPi * 720.0);
  const double slewing_s = kCommand_a / kSlew_a_per_s - tau_s;
  for (const double extra : {-0.5, 0.0, 0.5, 3.0}) {
    const double duration_s = slewing_s + extra * tau_s;
    const double found_a =
        FollowSlewing(MakeStep(720.0, kSlew_a_per_s, duration_s), 0.0, kCommand_a);
    const double expected_a = extra <= 0.0 ? kSlew_a_per_s * duration_s
                                           : kCommand_a - kSlew_a_per_s * tau_s * std::exp(-extra);
    EXPECT_NEAR(found_a, expected_a, 1e-14) << extra;  // rounding
  }
}

TEST(Follow, KeepsBothCoilsWithinTheCurrentsThatWereAskedFor) {
  // Any sequence of limited commands, with or without a slew limit: no coil leaves 0 .. maximum.
  Random random(36);
  const Limits limits{2.0, ConverterStep(2.0, 12)};
  for (const double slew_a_per_s : {0.0, 500.0, 1e5}) {
    const Step step = MakeStep(720.0, slew_a_per_s, 50e-6);
    double control_a = 0.0;
    double bias_a = 0.0;
    for (int i = 0; i < 20'000; ++i) {
      const CoilPair command = LimitedCommand(limits, random.Uniform() < 0.9, 3.0 * random.Normal(),
                                              2.0 * random.Uniform());
      Follow(step, command, control_a, bias_a);
      ASSERT_GE(bias_a - std::abs(control_a), -1e-13) << i;  // rounding
      ASSERT_LE(bias_a + std::abs(control_a), 2.0 + 1e-13) << i;
    }
  }
}

TEST(LimitedCommand, ChangesAsLittleAsTheLimitsAllow) {
  // Each coil gets the current nearest to what was asked of it: exact within, the limit beyond.
  Random random(37);
  for (int i = 0; i < 20'000; ++i) {
    const double control_a = 3.0 * random.Normal();
    const double bias_a = 2.0 * random.Uniform();
    const CoilPair pair = LimitedCommand({2.0, 0.0}, true, control_a, bias_a);
    for (const double sign : {1.0, -1.0}) {
      const double asked_a = bias_a + sign * control_a;
      const double given_a = pair.bias_a + sign * pair.control_a;
      const double nearest_a = asked_a < 0.0 ? 0.0 : asked_a > 2.0 ? 2.0 : asked_a;
      EXPECT_NEAR(given_a, nearest_a, 1e-15) << i;  // rounding of sum and difference
    }
  }
}

TEST(LimitedCommand, IsOddInTheControlCurrentConverterIncluded) {
  Random random(38);
  const Limits limits{2.0, ConverterStep(2.0, 10)};
  for (int i = 0; i < 5000; ++i) {
    const double control_a = 2.0 * random.Normal();
    const CoilPair one = LimitedCommand(limits, true, control_a, 0.8);
    const CoilPair other = LimitedCommand(limits, true, -control_a, 0.8);
    EXPECT_EQ(one.control_a, -other.control_a);
    EXPECT_EQ(one.bias_a, other.bias_a);
  }
}

TEST(ConverterStep, HalvesWithEveryBitAndCoversBothSidesOfTheRange) {
  for (int bits = 1; bits < 24; ++bits) {
    EXPECT_EQ(ConverterStep(2.0, bits), 2.0 * ConverterStep(2.0, bits + 1));
    EXPECT_EQ(ConverterStep(2.0, bits) * std::ldexp(1.0, bits), 4.0);
  }
}

TEST(Amplifier, ShowsACommandThatIsNoNumberAndForgetsItWhenSwitchedOff) {
  const double nan = std::nan("");
  for (const double step_a : {0.0, 1e-3}) {
    EXPECT_TRUE(std::isnan(LimitedCommand({2.0, step_a}, true, nan, 1.0).control_a));
    EXPECT_EQ(LimitedCommand({2.0, step_a}, false, nan, nan).bias_a, 0.0);
    EXPECT_EQ(LimitedCommand({2.0, step_a}, true, INFINITY, 1.0).control_a, 1.0);  // 2 A and 0 A
  }
  const Step step = MakeStep(720.0, 1000.0, 50e-6);
  EXPECT_TRUE(std::isnan(FollowSlewing(step, nan, 1.0)));
  EXPECT_TRUE(std::isnan(FollowSlewing(step, 1.0, nan)));
}

}  // namespace
}  // namespace levitas::amplifier

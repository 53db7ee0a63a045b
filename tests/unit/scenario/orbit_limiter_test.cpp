#include "controller/scenario/orbit_limiter.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "controller/scenario/scenario_player.hpp"

namespace levitas::scenario {
namespace {

constexpr double kLimiterPeriod_s = 1e-4;
constexpr double kLimit_m = 50e-6;

TEST(OrbitLimiter, LeavesAnExcitationAloneWithinTheLimit) {
  OrbitLimiter limiter(kLimiterPeriod_s);
  for (int n = 0; n < 1000; ++n) EXPECT_EQ(limiter.Next(0.99 * kLimit_m, kLimit_m), 1.0);
}

TEST(OrbitLimiter, FallsByOneEthInAMillisecondBeyondTheLimit) {
  OrbitLimiter limiter(kLimiterPeriod_s);
  double gain = 1.0;
  for (int n = 0; n < 10; ++n) gain = limiter.Next(1.2 * kLimit_m, kLimit_m);
  EXPECT_NEAR(gain, std::exp(-1.0), 1e-12);
}

TEST(OrbitLimiter, CutsOffAtOnceFarBeyondTheLimitAndForANumberThatIsNone) {
  for (const double radius_m : {1.5 * kLimit_m, 1.0, std::numeric_limits<double>::quiet_NaN()}) {
    OrbitLimiter limiter(kLimiterPeriod_s);
    EXPECT_EQ(limiter.Next(radius_m, kLimit_m), 0.0);
  }
}

TEST(OrbitLimiter, ComesBackWithinSecondsOnceItIsQuiet) {
  OrbitLimiter limiter(kLimiterPeriod_s);
  (void)limiter.Next(1.0, kLimit_m);
  for (int n = 0; n < 100; ++n) EXPECT_EQ(limiter.Next(0.9 * kLimit_m, kLimit_m), 0.0);
  double gain = 0.0;
  for (int n = 0; n < 10'000; ++n) gain = limiter.Next(0.5 * kLimit_m, kLimit_m);
  EXPECT_NEAR(gain, 1.0 - std::exp(-1.0), 1e-9);  // one time constant
}

TEST(OrbitLimiter, WithoutALimitDoesNothing) {
  OrbitLimiter limiter(kLimiterPeriod_s);
  EXPECT_EQ(limiter.Next(1.0, 0.0), 1.0);
}

TEST(ScenarioPlayer, CutsAnExcitationBackBeyondTheOrbitLimitOfItsStep) {
  Step step;
  step.hold_s = 1.0;
  step.orbit_limit_m = kLimit_m;
  Excitation current;
  current.order = 7;
  current.amplitude_a = 0.5;
  Excitation position;
  position.axis = 1;
  position.order = 7;
  position.point = Injection::kMeasuredPosition;
  position.amplitude_m = 10e-6;
  step.excitation = {current, position};
  ScenarioPlayer player({"test", {step}, {}}, kLimiterPeriod_s, 0.5);
  (void)player.Next(Mode::kLevitating, 0.0, Fault::kNone);
  const PlayerOutput quiet = player.Next(Mode::kLevitating, 0.0, Fault::kNone, false, 0.0);
  EXPECT_EQ(std::abs(quiet.excitation_a[0]), 0.5);
  EXPECT_EQ(quiet.excitation_a[1], 0.0);
  EXPECT_EQ(quiet.excitation_m[0], 0.0);
  EXPECT_EQ(std::abs(quiet.excitation_m[1]), 10e-6);
  const PlayerOutput far = player.Next(Mode::kLevitating, 0.0, Fault::kNone, false, kLimit_m * 2.0);
  EXPECT_EQ(far.excitation_a, AxisArray{});
  EXPECT_EQ(far.excitation_m, AxisArray{});
}

}  // namespace
}  // namespace levitas::scenario

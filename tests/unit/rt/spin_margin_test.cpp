#include "rt/spin_margin.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/random.hpp"

namespace levitas::rt {
namespace {

TEST(SpinMargin, StaysAtItsLeastOnAQuietMachine) {
  SpinMargin margin;
  for (int sleep = 0; sleep < 10'000; ++sleep) margin.Slept(13'000);
  EXPECT_EQ(margin.margin_ns(), SpinMargin::kLeastNs);
}

TEST(SpinMargin, NeverExceedsItsMostHoweverLateTheWakeUps) {
  SpinMargin margin;
  for (int sleep = 0; sleep < 10'000; ++sleep) margin.Slept(5'000'000);
  EXPECT_EQ(margin.margin_ns(), SpinMargin::kMostNs);
}

// Exponential lateness with mean 10 us: its 99 % quantile is 10 us x ln 100 = 46.05 us. The
// estimate wanders by about a step of 1 us x a few; its mean over 100,000 sleeps must come within
// 2 us.
TEST(SpinMargin, FindsTheQuantileOfARandomLateness) {
  Random random(20261121);
  SpinMargin margin;
  const auto sleep = [&] {
    margin.Slept(static_cast<std::int64_t>(-10'000.0 * std::log(1.0 - random.Uniform())));
  };
  for (int settle = 0; settle < 20'000; ++settle) sleep();
  double sum = 0.0;
  for (int count = 0; count < 100'000; ++count) {
    sleep();
    sum += static_cast<double>(margin.margin_ns());
  }
  EXPECT_NEAR(sum / 100'000, 10'000.0 * std::log(100.0), 2'000.0);
}

TEST(SpinMargin, ForgetsABusySpell) {
  SpinMargin margin;
  for (int sleep = 0; sleep < 1'000; ++sleep) margin.Slept(200'000);
  // From 60 us to 25 us in steps of 10 ns: 3,500 quiet sleeps.
  for (int sleep = 0; sleep < 3'500; ++sleep) margin.Slept(13'000);
  EXPECT_EQ(margin.margin_ns(), SpinMargin::kLeastNs);
}

}  // namespace
}  // namespace levitas::rt

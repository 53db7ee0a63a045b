// Sampling grid and spin margin over random histories, on written seeds.

#include <gtest/gtest.h>

#include <cmath>

#include "common/random.hpp"
#include "rt/next_wake.hpp"
#include "rt/spin_margin.hpp"

namespace levitas::rt {
namespace {

constexpr std::int64_t kYearNs = 365LL * 86'400 * 1'000'000'000;

TEST(NextWake, IsTheFirstInstantOfTheGridStillAheadForAnyPeriodAndLateness) {
  Random random(1);
  for (int draw = 0; draw < 100'000; ++draw) {
    const auto period_ns = static_cast<std::int64_t>(1 + random.Bits() % 2'000'000);
    const auto due_ns = static_cast<std::int64_t>(random.Bits() % kYearNs);
    const auto late_ns = static_cast<std::int64_t>(std::exp2(33.0 * random.Uniform()));
    const std::int64_t now_ns = due_ns + late_ns - 1'000;  // sometimes woken too early
    const Wake wake = NextWake(due_ns, period_ns, now_ns);
    ASSERT_EQ((wake.due_ns - due_ns) % period_ns, 0);
    ASSERT_GT(wake.due_ns, now_ns);
    ASSERT_GE(wake.skipped, 0);
    ASSERT_EQ(wake.due_ns, due_ns + (wake.skipped + 1) * period_ns);
    // Not one too far: the instant before had passed, or is the one just served.
    if (wake.skipped > 0) {
      ASSERT_LE(wake.due_ns - period_ns, now_ns);
    }
  }
}

TEST(NextWake, SkipsTheSameWhetherTheDelayIsTakenAtOnceOrCycleByCycle) {
  Random random(2);
  for (int draw = 0; draw < 2'000; ++draw) {
    const auto period_ns = static_cast<std::int64_t>(10 + random.Bits() % 200'000);
    const double periods = 64.0 * random.Uniform();
    const auto now_ns = static_cast<std::int64_t>(periods * static_cast<double>(period_ns));
    std::int64_t due_ns = 0;
    std::int64_t instants = 0;
    while (due_ns <= now_ns) {  // one period after the other
      due_ns += period_ns;
      ++instants;
    }
    const Wake wake = NextWake(0, period_ns, now_ns);
    ASSERT_EQ(wake.due_ns, due_ns);
    ASSERT_EQ(wake.skipped, instants - 1);
  }
}

TEST(FirstWake, LiesOnTheGridWithinOnePeriodAheadForAnyPhase) {
  Random random(3);
  for (int draw = 0; draw < 100'000; ++draw) {
    const auto period_ns = static_cast<std::int64_t>(1 + random.Bits() % 2'000'000);
    const auto phase_ns = static_cast<std::int64_t>(random.Bits() % (2 * kYearNs)) - kYearNs;
    const auto now_ns = static_cast<std::int64_t>(random.Bits() % kYearNs);
    const std::int64_t first_ns = FirstWake(phase_ns, period_ns, now_ns);
    ASSERT_GT(first_ns, now_ns);
    ASSERT_LE(first_ns, now_ns + period_ns);
    ASSERT_EQ((first_ns - phase_ns) % period_ns, 0);
  }
}

struct Lateness {
  const char* name;
  double quantile_ns;  ///< 99 %, from the inverse distribution at 0.99
  double (*inverse)(double);
};

constexpr Lateness kLatenesses[] = {
    {"uniform 0 to 50 us", 49'500.0, [](double u) { return 50'000.0 * u; }},
    {"exponential, mean 8 us", 36'841.4, [](double u) { return -8'000.0 * std::log(1.0 - u); }},
    {"Pareto from 5 us, exponent 2", 50'000.0,
     [](double u) { return 5'000.0 / std::sqrt(1.0 - u); }},
    {"10 us, and 45 us twice in a hundred", 45'000.0,
     [](double u) { return u < 0.98 ? 10'000.0 : 45'000.0; }},
};

TEST(SpinMargin, FollowsTheQuantileOfAnyDistribution) {
  for (const auto& lateness : kLatenesses) {
    Random random(4);
    SpinMargin margin;
    double sum = 0.0;
    constexpr int kSettle = 20'000;
    constexpr int kCount = 200'000;
    for (int sleep = 0; sleep < kSettle + kCount; ++sleep) {
      margin.Slept(static_cast<std::int64_t>(lateness.inverse(random.Uniform())));
      if (sleep >= kSettle) sum += static_cast<double>(margin.margin_ns());
    }
    // Steps of 1 us up: the estimate wanders by a few of them, more where the density is thin.
    EXPECT_NEAR(sum / kCount, lateness.quantile_ns, 2'500.0) << lateness.name;
  }
}

TEST(SpinMargin, LeavesOneWakeUpInAHundredLaterThanItself) {
  // What the rule promises whatever the distribution, as long as the bounds do not bind.
  for (const auto& lateness : kLatenesses) {
    Random random(5);
    SpinMargin margin;
    int later = 0;
    constexpr int kCount = 200'000;
    for (int sleep = 0; sleep < kCount; ++sleep) {
      const auto late_ns = static_cast<std::int64_t>(lateness.inverse(random.Uniform()));
      if (late_ns > margin.margin_ns()) ++later;
      margin.Slept(late_ns);
    }
    // up x 990 = down x 10 + the way travelled: at most 35 us/1 us = 35 of 2000.
    EXPECT_NEAR(later, kCount / 100, 36) << lateness.name;
  }
}

TEST(SpinMargin, NeverLeavesItsBoundsNorMovesMoreThanAStep) {
  Random random(6);
  SpinMargin margin;
  for (int sleep = 0; sleep < 100'000; ++sleep) {
    const std::int64_t before_ns = margin.margin_ns();
    // Early wake-ups and hours of lateness included.
    margin.Slept(static_cast<std::int64_t>(random.Normal() * std::exp2(43.0 * random.Uniform())));
    ASSERT_GE(margin.margin_ns(), SpinMargin::kLeastNs);
    ASSERT_LE(margin.margin_ns(), SpinMargin::kMostNs);
    ASSERT_LE(std::abs(margin.margin_ns() - before_ns), SpinMargin::kStepUpNs);
  }
}

}  // namespace
}  // namespace levitas::rt

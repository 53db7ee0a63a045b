#include "rt/next_wake.hpp"

#include <gtest/gtest.h>

#include "common/random.hpp"

namespace levitas::rt {
namespace {

constexpr std::int64_t kPeriod = 100'000;

TEST(NextWake, IsOnePeriodLaterWhenTheCycleWasInTime) {
  const Wake wake = NextWake(1'000'000, kPeriod, 1'040'000);
  EXPECT_EQ(wake.due_ns, 1'100'000);
  EXPECT_EQ(wake.skipped, 0);
}

TEST(NextWake, CountsAnOverrunFromTheVeryInstantOfTheNextPeriod) {
  EXPECT_EQ(NextWake(0, kPeriod, kPeriod - 1).skipped, 0);
  EXPECT_EQ(NextWake(0, kPeriod, kPeriod).skipped, 1);
}

TEST(NextWake, KeepsThePhaseOfTheGridAfterAnOverrun) {
  const Wake wake = NextWake(1'000'000, kPeriod, 1'370'001);
  EXPECT_EQ(wake.due_ns, 1'400'000);
  EXPECT_EQ(wake.skipped, 3);  // 1.1, 1.2 and 1.3 ms passed
}

TEST(NextWake, AccountsForEveryPeriodOfAnyHistory) {
  Random random(20261121);
  const std::int64_t phase = 12'345;
  std::int64_t due = phase;
  std::int64_t started = 0;
  std::int64_t skipped = 0;
  for (int cycle = 0; cycle < 100'000; ++cycle) {
    // Mostly in time, sometimes up to 20 periods late.
    const double late = random.Uniform() < 0.95 ? random.Uniform() : 20.0 * random.Uniform();
    const std::int64_t now = due + static_cast<std::int64_t>(late * kPeriod);
    const Wake wake = NextWake(due, kPeriod, now);
    ASSERT_GT(wake.due_ns, now);
    ASSERT_EQ((wake.due_ns - phase) % kPeriod, 0);
    due = wake.due_ns;
    skipped += wake.skipped;
    ++started;
  }
  EXPECT_EQ(started + skipped, (due - phase) / kPeriod);
}

TEST(FirstWake, IsTheFirstGridInstantAfterNowOnEitherSideOfThePhase) {
  EXPECT_EQ(FirstWake(30, 100, 30), 130);
  EXPECT_EQ(FirstWake(30, 100, 129), 130);
  EXPECT_EQ(FirstWake(30, 100, 131), 230);
  EXPECT_EQ(FirstWake(530, 100, 1), 30);  // the phase may lie in the future
}

}  // namespace
}  // namespace levitas::rt

#include "rt/real_time.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>

#include <thread>

#include "rt/clock.hpp"

namespace levitas::rt {
namespace {

TEST(RealTimeText, NamesARefusalWithItsRemedyAndAGrantWithItsValue) {
  const std::vector<RealTimeFact> facts{{"SCHED_FIFO", false, "not permitted; run as root"},
                                        {"timer slack", true, "1 ns"}};
  EXPECT_EQ(Text(facts), "no SCHED_FIFO: not permitted; run as root\ntimer slack: 1 ns\n");
}

// What is granted depends on the machine; that the facts tell the truth does not.
TEST(EnterThread, SaysFifoExactlyWhenTheKernelSchedulesSo) {
  std::thread([] {
    const auto facts = EnterThread({.priority = 10});
    ASSERT_FALSE(facts.empty());
    const RealTimeFact& fifo = facts.back();
    EXPECT_EQ(fifo.name, "SCHED_FIFO");
    const int policy = sched_getscheduler(0) & ~SCHED_RESET_ON_FORK;
    EXPECT_EQ(fifo.granted, policy == SCHED_FIFO);
    EXPECT_FALSE(fifo.detail.empty());
  }).join();
}

TEST(EnterThread, RefusesAProcessorThatIsNotThere) {
  std::thread([] {
    const auto facts = EnterThread({.priority = 10, .processor = 1000});
    EXPECT_FALSE(facts.front().granted);
    EXPECT_THAT(facts.front().detail, testing::HasSubstr("no processor 1000"));
  }).join();
}

TEST(EnterThread, RefusesAPriorityThatFifoDoesNotHave) {
  std::thread([] {
    const auto facts = EnterThread({.priority = 100});  // 1 to 99 exist
    EXPECT_FALSE(facts.back().granted);
    EXPECT_THAT(facts.back().detail, testing::HasSubstr("limits.conf"));
  }).join();
}

TEST(MonotonicClock, NeverReturnsBeforeTheInstantItWasGiven) {
  MonotonicClock clock;
  for (const std::int64_t ahead_ns : {0, 1'000, 30'000, 300'000}) {
    const std::int64_t due_ns = clock.NowNs() + ahead_ns;
    clock.SleepUntil(due_ns);
    EXPECT_GE(clock.NowNs(), due_ns);
  }
}

TEST(MonotonicClock, ReturnsFromAnInstantThatHasPassed) {
  MonotonicClock clock;
  const std::int64_t before_ns = clock.NowNs();
  clock.SleepUntil(before_ns - 1'000'000'000);
  clock.SleepUntil(0);
  EXPECT_GE(clock.NowNs(), before_ns);  // reached at all: it did not hang
}

}  // namespace
}  // namespace levitas::rt

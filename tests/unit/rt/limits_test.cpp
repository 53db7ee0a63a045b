#include "rt/limits.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

namespace levitas::rt {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

constexpr rlim_t kNone = RLIM_INFINITY;

TEST(CpuTime, WithoutALimitIsNoMatter) {
  const CpuTimePlan plan = PlanCpuTime({kNone, kNone});
  EXPECT_EQ(plan.soft_s, kNone);
  EXPECT_TRUE(plan.enough);
  EXPECT_THAT(plan.said, IsEmpty());
}

TEST(CpuTime, OfASoftLimitThatAnnouncesItselfStaysAndIsSaid) {
  for (const rlim_t hard_s : {kNone, rlim_t{10'000}}) {
    const CpuTimePlan plan = PlanCpuTime({100, hard_s});
    EXPECT_EQ(plan.soft_s, 100U);
    EXPECT_THAT(plan.said, HasSubstr("landed after 100 s"));
  }
}

TEST(CpuTime, OfAHardLimitIsHalfOrTheReserveForTheLanding) {
  for (const rlim_t soft_s : {kNone, rlim_t{10'000}}) {
    EXPECT_EQ(PlanCpuTime({soft_s, 10'000}).soft_s, 10'000 - kLandingReserveS);
  }
  EXPECT_EQ(PlanCpuTime({600, 600}).soft_s, 300U);
  EXPECT_EQ(PlanCpuTime({9, 9}).soft_s, 4U);
  EXPECT_EQ(PlanCpuTime({2, 2}).soft_s, 1U);
  EXPECT_TRUE(PlanCpuTime({2, 2}).enough);
}

// Whole seconds are all that the kernel has: nothing lies before the first.
TEST(CpuTime, OfOneSecondLeavesNoLanding) {
  for (const rlim_t hard_s : {rlim_t{0}, rlim_t{1}}) {
    const CpuTimePlan plan = PlanCpuTime({hard_s, hard_s});
    EXPECT_FALSE(plan.enough);
    EXPECT_THAT(plan.said, HasSubstr("leaves none for a landing"));
  }
}

volatile std::sig_atomic_t announced = 0;

/// The status of waitpid of a child that counts until it is announced that its time is over, or
/// until it is killed.
int EndOfAChildThatHas(const rlimit& limit, bool reserves) {
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGXCPU, [](int) { announced = 1; });
    setrlimit(RLIMIT_CPU, &limit);
    if (reserves) (void)ReserveCpuTime();
    while (announced == 0) {
    }
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return status;
}

// As a pair: the kernel as it is, and with the soft limit lowered.
TEST(CpuTime, IsUpWithoutAWordUnlessSomeIsReserved) {
  const int unannounced = EndOfAChildThatHas({2, 2}, false);
  ASSERT_TRUE(WIFSIGNALED(unannounced));
  EXPECT_EQ(WTERMSIG(unannounced), SIGKILL);
  const int told = EndOfAChildThatHas({2, 2}, true);
  ASSERT_TRUE(WIFEXITED(told));
  EXPECT_EQ(WEXITSTATUS(told), 0);
}

TEST(Stack, IsRaisedWhereThatIsAllowedElseRefused) {
  const rlim_t small = 64 << 10;
  EXPECT_EQ(PlanStack({kNone, kNone}).soft, kNone);
  EXPECT_EQ(PlanStack({kLeastStack, kNone}).soft, kLeastStack);
  EXPECT_TRUE(PlanStack({kLeastStack, kLeastStack}).enough);
  EXPECT_EQ(PlanStack({small, kNone}).soft, kLeastStack);
  EXPECT_TRUE(PlanStack({small, kLeastStack}).enough);
  EXPECT_FALSE(PlanStack({small, kLeastStack - 1}).enough);
  EXPECT_FALSE(PlanStack({small, small}).enough);
}

}  // namespace
}  // namespace levitas::rt

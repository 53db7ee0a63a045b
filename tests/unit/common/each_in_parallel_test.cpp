#include "common/each_in_parallel.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>

#include <barrier>
#include <cstdlib>
#include <set>

#include "common/problem.hpp"

namespace levitas {
namespace {

class Threads : public testing::Test {
 protected:
  Threads() { ::unsetenv("LEVITAS_THREADS"); }
  ~Threads() override { ::unsetenv("LEVITAS_THREADS"); }
  static void Tell(const char* number) { ::setenv("LEVITAS_THREADS", number, 1); }
};

TEST_F(Threads, DoEveryIndexOnceHoweverManyThereAre) {
  for (const std::size_t threads : {0U, 1U, 2U, 7U}) {
    for (const std::size_t count : {0U, 1U, 2U, 50U}) {
      std::vector<std::atomic<int>> calls(count);
      EachInParallel(count, threads, [&](std::size_t i) { ++calls[i]; });
      for (const auto& of_index : calls) EXPECT_EQ(of_index, 1) << threads;
    }
  }
}

// Each waits until all are there: fewer threads would wait for good.
TEST_F(Threads, AreAsManyAsAskedFor) {
  Tell("3");
  std::barrier all(3);
  std::vector<std::thread::id> of(3);
  EachInParallel(of.size(), 0, [&](std::size_t i) {
    of[i] = std::this_thread::get_id();
    all.arrive_and_wait();
  });
  EXPECT_EQ((std::set<std::thread::id>(of.begin(), of.end()).size()), 3U);
}

TEST_F(Threads, AreThoseThatTheProcessMayRunOn) {
  cpu_set_t before;
  ASSERT_EQ(::sched_getaffinity(0, sizeof before, &before), 0);
  EXPECT_EQ(Processors(), static_cast<std::size_t>(CPU_COUNT(&before)));
  std::size_t first = 0;
  while (!CPU_ISSET(first, &before)) ++first;
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(first, &one);
  ASSERT_EQ(::sched_setaffinity(0, sizeof one, &one), 0);
  EXPECT_EQ(Processors(), 1U);
  ASSERT_EQ(::sched_setaffinity(0, sizeof before, &before), 0);
}

TEST_F(Threads, ToldAsNoNumberAreRefusedInOneSentence) {
  for (const char* wrong : {"0", "two", "-1", "2 ", "1025", "99999999999999999999"}) {
    Tell(wrong);
    try {
      (void)Processors();
      FAIL() << wrong;
    } catch (const Problem& problem) {
      EXPECT_EQ(problem.status(), ExitStatus::kUsage);
      EXPECT_THAT(problem.what(), testing::HasSubstr(wrong));
      EXPECT_THAT(problem.what(), testing::HasSubstr("allowed 1 to 1024"));
    }
  }
}

TEST_F(Threads, ThatFailEndTheWorkOfNoOther) {
  for (const char* threads : {"1", "3"}) {
    Tell(threads);
    std::vector<int> done(6, 0);
    try {
      EachThatMayFail(done.size(), 0, [&done](std::size_t i) {
        if (i == 2 || i == 4) throw BadInput("of " + std::to_string(i));
        done[i] = 1;
      });
      FAIL() << threads;
    } catch (const BadInput& problem) {
      EXPECT_STREQ(problem.what(), "of 2") << "of the lowest index";
    }
    EXPECT_EQ(done, (std::vector<int>{1, 1, 0, 1, 0, 1}));
  }
}

}  // namespace
}  // namespace levitas

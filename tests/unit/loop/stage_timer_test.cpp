#include <gtest/gtest.h>

#include <set>
#include <string>

#include "controller/loop/loop_statistics.hpp"
#include "tests/unit/loop/fakes.hpp"

namespace levitas::loop {
namespace {

using cycle::Stage;

class Stages : public testing::Test {
 protected:
  void Take(Stage stage, std::int64_t duration_ns) {
    clock_.now_ns += duration_ns;
    timer_.Ended(stage);
  }
  [[nodiscard]] const Histogram& Of(Stage stage) const {
    return statistics_.stage[static_cast<std::size_t>(stage)];
  }

  test::FakeClock clock_;
  LoopStatistics statistics_;
  StageTimer timer_{clock_, statistics_};
};

TEST_F(Stages, TakeTheTimeSinceTheEndOfTheStageBefore) {
  timer_.Start(0);
  Take(Stage::kRead, 100);
  Take(Stage::kLaw, 2'000);
  EXPECT_EQ(Of(Stage::kRead).max_ns(), 100);
  EXPECT_EQ(Of(Stage::kLaw).max_ns(), 2'000);
  EXPECT_EQ(Of(Stage::kWrite).count(), 0U);
  EXPECT_EQ(timer_.last_ns(), 2'100);
}

TEST_F(Stages, BlameTheLongestOfTheirCycleAlone) {
  timer_.Start(0);
  Take(Stage::kWrite, 9'000);
  EXPECT_EQ(timer_.Longest(), Stage::kWrite);
  timer_.Start(clock_.now_ns);
  Take(Stage::kRead, 10);
  Take(Stage::kCheck, 30);
  Take(Stage::kWrite, 20);
  EXPECT_EQ(timer_.Longest(), Stage::kCheck);
}

// Wait, law, wait: a stage that comes twice in a cycle is as long as both.
TEST_F(Stages, AddUpWhereOneComesTwice) {
  timer_.Start(0);
  Take(Stage::kRead, 60);
  Take(Stage::kLaw, 100);
  Take(Stage::kRead, 60);
  EXPECT_EQ(timer_.Longest(), Stage::kRead);
}

// From the instant it should have woken: a late wake-up belongs to the wait.
TEST_F(Stages, CountALateWakeUpAsWaiting) {
  clock_.now_ns = 5'000;
  timer_.Start(1'000);
  timer_.Ended(Stage::kWait);
  EXPECT_EQ(Of(Stage::kWait).max_ns(), 4'000);
}

TEST(StageNames, AreDistinct) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < cycle::kStageCount; ++i) {
    names.insert(StageName(static_cast<Stage>(i)));
  }
  EXPECT_EQ(names.size(), cycle::kStageCount);
}

}  // namespace
}  // namespace levitas::loop

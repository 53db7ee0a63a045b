#include "verdict/phase.hpp"

#include <gtest/gtest.h>

namespace levitas::verdict {
namespace {

constexpr double kStandstill = 1.0;

TEST(PhaseSplitter, JudgesNoModeThatMovesTheRotorOnPurpose) {
  PhaseSplitter split(kStandstill, 0);
  std::uint64_t cycle = 0;
  for (const Mode mode :
       {Mode::kOff, Mode::kSelfTest, Mode::kLift, Mode::kLanding, Mode::kTripped}) {
    EXPECT_EQ(split.Next(cycle++, mode, 0.0), Phase::kNotJudged) << Name(mode);
    EXPECT_EQ(split.Next(cycle++, mode, 300.0), Phase::kNotJudged) << Name(mode);
  }
}

TEST(PhaseSplitter, DividesTheLevitatedModesBySpeedNotByName) {
  PhaseSplitter split(kStandstill, 0);
  std::uint64_t cycle = 0;
  for (const Mode mode : {Mode::kLevitating, Mode::kSpinning, Mode::kCoastDown}) {
    EXPECT_EQ(split.Next(cycle++, mode, 0.0), Phase::kStanding) << Name(mode);
    EXPECT_EQ(split.Next(cycle++, mode, kStandstill), Phase::kStanding) << Name(mode);
    EXPECT_EQ(split.Next(cycle++, mode, 1.01 * kStandstill), Phase::kSpinning) << Name(mode);
    EXPECT_EQ(split.Next(cycle++, mode, -300.0), Phase::kSpinning) << Name(mode);
  }
}

TEST(PhaseSplitter, LeavesOutExactlyTheSettlingCyclesAfterEachLift) {
  PhaseSplitter split(kStandstill, 3);
  std::uint64_t cycle = 40;
  for (int lift = 0; lift < 2; ++lift) {
    EXPECT_EQ(split.Next(cycle++, Mode::kLift, 0.0), Phase::kNotJudged);
    for (int i = 0; i < 3; ++i) {
      EXPECT_EQ(split.Next(cycle++, Mode::kLevitating, 0.0), Phase::kNotJudged) << i;
    }
    EXPECT_EQ(split.Next(cycle++, Mode::kLevitating, 0.0), Phase::kStanding);
    EXPECT_EQ(split.Next(cycle++, Mode::kLanding, 0.0), Phase::kNotJudged);
  }
}

TEST(PhaseSplitter, DoesNotSettleAgainBetweenLevitatedModes) {
  PhaseSplitter split(kStandstill, 2);
  std::uint64_t cycle = 0;
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(split.Next(cycle++, Mode::kLevitating, 0.0), Phase::kNotJudged);
  }
  EXPECT_EQ(split.Next(cycle++, Mode::kSpinning, 5.0), Phase::kSpinning);
  EXPECT_EQ(split.Next(cycle++, Mode::kCoastDown, 5.0), Phase::kSpinning);
  EXPECT_EQ(split.Next(cycle++, Mode::kLevitating, 0.0), Phase::kStanding);
}

// Lost records must not stretch the settling time: it is counted in cycle numbers.
TEST(PhaseSplitter, CountsSettlingInCycleNumbersAcrossGaps) {
  PhaseSplitter split(kStandstill, 100);
  EXPECT_EQ(split.Next(10, Mode::kLevitating, 0.0), Phase::kNotJudged);
  EXPECT_EQ(split.Next(109, Mode::kLevitating, 0.0), Phase::kNotJudged);
  EXPECT_EQ(split.Next(110, Mode::kLevitating, 0.0), Phase::kStanding);
}

}  // namespace
}  // namespace levitas::verdict

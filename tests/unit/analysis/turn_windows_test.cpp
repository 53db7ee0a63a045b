#include "analysis/turn_windows.hpp"

#include <gtest/gtest.h>

#include <cstdint>

namespace levitas::analysis {
namespace {

// No whole number of rows is a whole number of turns, so that rounding decides nothing: four turns
// are 29.2 rows, which 30 are the first to hold.
constexpr double kRowsPerTurn = 7.3;
constexpr std::size_t kRowsOfFourTurns = 30;

struct TurningRecord {
  std::vector<std::uint64_t> cycle;
  std::vector<std::uint8_t> levitated;
  std::vector<double> speed_rad_per_s;
  std::vector<double> angle_rad;  ///< wrapped
};

TurningRecord HeldTurning(std::size_t rows, double sense = 1.0) {
  constexpr double kWholeTurn = 2.0 * std::numbers::pi;
  TurningRecord record;
  for (std::size_t i = 0; i < rows; ++i) {
    record.cycle.push_back(1000 + i);
    record.levitated.push_back(1);
    record.speed_rad_per_s.push_back(sense * 100.0);
    record.angle_rad.push_back(
        std::fmod(sense * kWholeTurn / kRowsPerTurn * static_cast<double>(i), kWholeTurn));
  }
  return record;
}

/// Four turns, whatever time they take.
TurnRule FourTurns() {
  TurnRule rule;
  rule.standstill_rad_per_s = 10.0;
  rule.least_turns = 4.0;
  rule.least_s = 0.0;
  rule.period_s = 1e-3;
  return rule;
}

void ExpectWindow(const TurnWindow& window, std::size_t first, std::size_t rows) {
  EXPECT_EQ(window.first, first);
  EXPECT_EQ(window.last - window.first + 1, rows);
}

TEST(TurnWindows, AreTheFewestRowsThatHoldTheTurnsAndOverlapByHalfInEitherSense) {
  for (const double sense : {1.0, -1.0}) {
    SCOPED_TRACE(sense);
    const auto windows = TurnWindows(HeldTurning(100, sense), FourTurns());
    ASSERT_GE(windows.size(), 2U);
    ExpectWindow(windows[0], 0, kRowsOfFourTurns);
    for (std::size_t i = 1; i < windows.size(); ++i) {
      const std::size_t ahead = windows[i].first - windows[i - 1].first;
      EXPECT_NEAR(static_cast<double>(ahead), 0.5 * kRowsOfFourTurns, 1.0) << "to a whole row";
      ExpectWindow(windows[i], windows[i].first, kRowsOfFourTurns);
      EXPECT_LT(windows[i].last, 100U);
    }
  }
}

TEST(TurnWindows, AreLongerByWholeTurnsUntilTheyLastLongEnough) {
  TurnRule rule = FourTurns();
  rule.least_s = 0.0505;  // six turns take 43.8 ms, seven 51.1 ms: 52 rows
  const auto windows = TurnWindows(HeldTurning(60), rule);
  ASSERT_EQ(windows.size(), 1U);
  ExpectWindow(windows[0], 0, 52);
}

TEST(TurnWindows, HoldNoMissingCycleAndNoRowThatIsNotHeld) {
  TurningRecord record = HeldTurning(110);
  for (std::size_t i = 40; i < 110; ++i) record.cycle[i] += 5;  // cycles are gone before row 40
  record.levitated[75] = 0;
  const auto windows = TurnWindows(record, FourTurns());
  ASSERT_EQ(windows.size(), 3U) << "one in each piece of 40, 35 and 34 rows";
  ExpectWindow(windows[0], 0, kRowsOfFourTurns);
  ExpectWindow(windows[1], 40, kRowsOfFourTurns);
  ExpectWindow(windows[2], 76, kRowsOfFourTurns);
}

TEST(TurnWindows, AreNoneOfARotorThatStands) {
  TurnRule rule = FourTurns();
  rule.standstill_rad_per_s = 100.0;  // the speed itself: turning is what is faster
  EXPECT_TRUE(TurnWindows(HeldTurning(100), rule).empty());
  EXPECT_TRUE(TurnWindows(TurningRecord{}, FourTurns()).empty());
}

}  // namespace
}  // namespace levitas::analysis

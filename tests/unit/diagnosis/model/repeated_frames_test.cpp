// Readings that repeat: chance with a coarse converter, losses with a fine one.

#include "diagnosis/model/repeated_frames.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/random.hpp"

namespace levitas::diagnosis {
namespace {

constexpr std::size_t kAxes = 4;
constexpr std::size_t kRows = 20'000;

/// Noise of unit rms behind a converter; every `lose`-th frame holds the readings before it.
std::vector<analysis::RecordedRow> Rows(double step, std::size_t lose, double moves = 0.0) {
  Random random(7);
  std::vector<analysis::RecordedRow> rows(kRows);
  for (std::size_t n = 0; n < kRows; ++n) {
    rows[n].cycle = n;
    rows[n].levitated = true;
    if (lose > 0 && n % lose == lose - 1) {
      rows[n].sample.position_m = rows[n - 1].sample.position_m;
      continue;
    }
    for (std::size_t a = 0; a < kAxes; ++a) {
      const double place = moves * std::sin(0.03 * static_cast<double>(n));
      rows[n].sample.position_m[a] = step * std::round((place + random.Normal()) / step);
    }
  }
  return rows;
}

TEST(RepeatedFrames, OfACoarseConverterAreChance) {
  const RepeatedFrames repeated = CountRepeats(Rows(1.0, 0), kAxes);
  // Two normal numbers fall into one cell of their own deviation in 27 % of all cases.
  EXPECT_NEAR(repeated.by_chance, std::pow(0.27, 4.0) * kRows, 40.0);
  EXPECT_GT(repeated.count, 50U);
  EXPECT_FALSE(repeated.AreLost());
}

TEST(RepeatedFrames, OfAFineConverterAreLostHoweverFew) {
  const RepeatedFrames repeated = CountRepeats(Rows(0.01, 10'000), kAxes);
  EXPECT_EQ(repeated.count, 2U);
  EXPECT_LT(repeated.by_chance, 0.01);
  EXPECT_TRUE(repeated.AreLost());
  EXPECT_FALSE(CountRepeats(Rows(0.01, 0), kAxes).AreLost());
}

TEST(RepeatedFrames, OfACoarseConverterThatAreManyTimesChanceAreLost) {
  EXPECT_TRUE(CountRepeats(Rows(1.0, 20), kAxes).AreLost());
}

TEST(RepeatedFrames, OfAMovingRotorAreCountedWhereItTurnsRound) {
  // All axes swing together and stand still together: fewer repeat, in the same stretches.
  EXPECT_FALSE(CountRepeats(Rows(1.0, 0, 100.0), kAxes).AreLost());
}

TEST(RepeatedFrames, OnlyCountBetweenConsecutiveLevitatedCycles) {
  auto rows = Rows(0.01, 10);
  for (auto& row : rows) row.levitated = false;
  EXPECT_EQ(CountRepeats(rows, kAxes).count, 0U);
  rows = Rows(0.01, 10);
  for (auto& row : rows) row.cycle *= 2;
  EXPECT_EQ(CountRepeats(rows, kAxes).count, 0U);
}

}  // namespace
}  // namespace levitas::diagnosis

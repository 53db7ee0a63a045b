// Readings that a recorder has spoilt are named; what a rig's own probes and frames do is not.

#include "diagnosis/record_errors/readings.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/diagnosis/recorded_loop.hpp"

namespace levitas::diagnosis {
namespace {

template <class Find>
RecordErrors Found(const Record& record, Find find) {
  RecordErrors out;
  find(RotorView(), AllColumns(record), out);
  return out;
}

void Round(Record& record, std::size_t axis, double step_m) {
  for (auto& row : record.rows)
    row.sample.position_m[axis] = step_m * std::round(row.sample.position_m[axis] / step_m);
}

void Clip(Record& record, std::size_t axis, double most_m) {
  for (auto& row : record.rows)
    row.sample.position_m[axis] = std::min(row.sample.position_m[axis], most_m);
}

TEST(Quantised, StepsAboveConverterAndNoiseAreNamedWithTheirSize) {
  Record record = RecordedLoop();
  Round(record, 1, 3e-6);
  const RecordErrors found = Found(record, FindQuantised);
  ASSERT_EQ(found.errors.size(), 1U);
  EXPECT_EQ(found.errors[0].columns, std::vector<std::string>{"position_de_y"});
  EXPECT_NEAR(found.errors[0].size, 3e-6, 1e-9);
  EXPECT_FALSE(found.errors[0].by_map);
}

TEST(Quantised, ReadingsWithoutStepsAreNot) {
  EXPECT_TRUE(Found(RecordedLoop(), FindQuantised).errors.empty());
}

TEST(Quantised, StepsBelowTheNoiseAreNot) {
  Record record = RecordedLoop();
  Round(record, 1, 0.8e-6);  // the probe's noise is 1 um
  EXPECT_TRUE(Found(record, FindQuantised).errors.empty());
}

TEST(Clipped, APlateauIsNamedWithItsPlace) {
  Record record = RecordedLoop();
  Clip(record, 2, 8e-6);
  const RecordErrors found = Found(record, FindClipped);
  ASSERT_EQ(found.errors.size(), 1U);
  EXPECT_EQ(found.errors[0].columns, std::vector<std::string>{"position_nde_x"});
  EXPECT_DOUBLE_EQ(found.errors[0].size, 8e-6);
}

TEST(Clipped, TheLargestValuesOfFreeReadingsAreNoPlateau) {
  EXPECT_TRUE(Found(RecordedLoop(), FindClipped).errors.empty());
}

TEST(Clipped, ThePlateauOfTheProbesOwnRangeIsTheRigs) {
  const double range_m = RotorView().bearing(2).sensor.range_m;
  Record record = RecordedLoop();
  for (auto& row : record.rows) row.sample.position_m[2] += range_m;
  Clip(record, 2, range_m);
  EXPECT_TRUE(Found(record, FindClipped).errors.empty());
}

TEST(Clipped, AFewEqualValuesAreChance) {
  Record record = RecordedLoop();
  double most_m = 0.0;
  for (const auto& row : record.rows) most_m = std::max(most_m, row.sample.position_m[0]);
  for (std::size_t n = 0; n < 19; ++n) record.rows[100 * n].sample.position_m[0] = 1.1 * most_m;
  EXPECT_TRUE(Found(record, FindClipped).errors.empty());
}

TEST(Held, EverySecondRowIsNamedWithItsShare) {
  Record record = RecordedLoop();
  for (std::size_t n = 1; n < record.rows.size(); n += 2)
    record.rows[n].sample.position_m[3] = record.rows[n - 1].sample.position_m[3];
  const RecordErrors found = Found(record, FindHeld);
  ASSERT_EQ(found.errors.size(), 1U);
  EXPECT_EQ(found.errors[0].columns, std::vector<std::string>{"position_nde_y"});
  EXPECT_DOUBLE_EQ(found.errors[0].size, 0.5);
}

TEST(Held, ACurrentNowAndThenIsNamedFromThreeInAHundredRowsOn) {
  for (const std::size_t every : {20U, 50U}) {  // 5 and 2 %, at no fixed distance
    Record record = RecordedLoop();
    std::mt19937_64 draw{7};
    for (std::size_t n = 1; n < record.rows.size(); ++n) {
      if (draw() % every != 0) continue;
      record.rows[n].sample.command.control_current_a[0] =
          record.rows[n - 1].sample.command.control_current_a[0];
    }
    const RecordErrors found = Found(record, FindHeld);
    ASSERT_EQ(found.errors.size(), every == 20 ? 1U : 0U);
    for (const RecordError& error : found.errors)
      EXPECT_EQ(error.columns, std::vector<std::string>{"control_current_de_x"});
  }
}

TEST(Held, ReadingsThatAllRepeatNowAndThenAreLostFramesWhichTheDiagnosisKnows) {
  Record record = RecordedLoop();
  std::mt19937_64 draw{7};
  for (std::size_t n = 1; n < record.rows.size(); ++n) {
    if (draw() % 10 == 0) record.rows[n].sample.position_m = record.rows[n - 1].sample.position_m;
  }
  EXPECT_TRUE(Found(record, FindHeld).errors.empty());
}

TEST(Held, ACurrentAtItsLimitStandsThereByRight) {
  Record record = RecordedLoop();
  for (std::size_t n = 0; n < record.rows.size() / 2; ++n)
    record.rows[n].sample.command.control_current_a[0] = CurrentLimit(RotorView(), 0);
  EXPECT_TRUE(Found(record, FindHeld).errors.empty());
}

}  // namespace
}  // namespace levitas::diagnosis

// Rows in contact with a touchdown bearing, or without current, are left out; flight stays.

#include "diagnosis/records/levitated_interval.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/diagnosis/moments.hpp"

namespace levitas::diagnosis {
namespace {

constexpr std::size_t kRows = 20'000;

/// A rotor that flies near the centre, its controller at work.
Record Flight() {
  Record record;
  record.rows.resize(kRows);
  for (std::size_t n = 0; n < kRows; ++n) {
    analysis::RecordedRow& row = record.rows[n];
    row.cycle = n;
    row.levitated = true;
    row.sample.position_m = {5e-6, -3e-6, 2e-6, 4e-6};
    row.sample.command.control_current_a = {0.1, 0.1, 0.1, 0.1};
  }
  return record;
}

bool Has(const Record& record, std::uint64_t cycle) {
  for (const auto& row : record.rows) {
    if (row.cycle == cycle) return true;
  }
  return false;
}

TEST(FreeFlight, IsKeptWhole) {
  Record record = Flight();
  LeaveOutContactAndWays(TheRig(), record);
  EXPECT_EQ(record.rows.size(), kRows);
}

TEST(FreeFlight, IsNotWhereTheRotorLiesWithoutCurrent) {
  Record record = Flight();
  for (std::size_t n = 0; n < 3000; ++n) record.rows[n].sample.command.control_current_a = {};
  LeaveOutContactAndWays(TheRig(), record);
  EXPECT_FALSE(Has(record, 2999));
  EXPECT_FALSE(Has(record, 8999));  // the lift still swings
  EXPECT_TRUE(Has(record, 9000));
}

TEST(FreeFlight, BeginsEarlierWhereTheModeTellsTheLift) {
  Record record = Flight();
  for (std::size_t n = 0; n < 3000; ++n) record.rows[n].sample.command.control_current_a = {};
  for (std::size_t n = 0; n < 3200; ++n) record.rows[n].levitated = false;
  LeaveOutContactAndWays(TheRig(), record);
  EXPECT_FALSE(Has(record, 3499));
  EXPECT_TRUE(Has(record, 3500));
}

TEST(FreeFlight, IsNotBeyondHalfTheClearance) {
  Record record = Flight();
  // 190 um of clearance; 70 um in both axes are 99 um away from the centre.
  record.rows[10'000].sample.position_m = {0.0, 0.0, 70e-6, 70e-6};
  record.rows[17'000].sample.position_m = {0.0, 0.0, 60e-6, 60e-6};
  LeaveOutContactAndWays(TheRig(), record);
  EXPECT_FALSE(Has(record, 9'501));
  EXPECT_FALSE(Has(record, 10'499));
  EXPECT_TRUE(Has(record, 9'499));
  EXPECT_TRUE(Has(record, 16'501));
  EXPECT_TRUE(Has(record, 17'000));
}

// Lowered by 0.1 um a row from row 15 000 on: it is beyond a fifth of the clearance, 38 um, from
// row 15 268 on (1.414 times the way), beyond half from 15 671 on.
TEST(FreeFlight, IsNotOnTheWayToTheTouchdownBearings) {
  Record record = Flight();
  for (std::size_t n = 15'000; n < kRows; ++n) {
    const double way_m = -1e-7 * static_cast<double>(n - 15'000);
    record.rows[n].sample.position_m = {way_m, way_m, way_m, way_m};
  }
  LeaveOutContactAndWays(TheRig(), record);
  EXPECT_TRUE(Has(record, 14'700));
  EXPECT_FALSE(Has(record, 15'270));
  EXPECT_EQ(record.rows.back().cycle + 1, record.rows.size());
}

TEST(FreeFlight, HasItsWaysLeftOutBehindAReadingThatIsNoNumberToo) {
  Record record = Flight();
  record.rows[9'000].sample.position_m[2] = std::nan("");
  for (std::size_t n = 15'000; n < kRows; ++n) {
    const double way_m = -1e-7 * static_cast<double>(n - 15'000);
    record.rows[n].sample.position_m = {way_m, way_m, way_m, way_m};
  }
  LeaveOutContactAndWays(TheRig(), record);
  EXPECT_TRUE(Has(record, 14'700));
  EXPECT_FALSE(Has(record, 15'270));
}

// Its ways are what shows units and wires: a search for errors of the record keeps them.
TEST(FreeFlight, OfAllThatTheRotorDoesNotTouchHasItsWays) {
  Record record = Flight();
  for (std::size_t n = 15'000; n < kRows; ++n) {
    const double way_m = -1e-7 * static_cast<double>(n - 15'000);
    record.rows[n].sample.position_m = {way_m, way_m, way_m, way_m};
  }
  for (std::size_t n = 0; n < 3000; ++n) record.rows[n].sample.command.control_current_a = {};
  LeaveOutContact(TheRig(), record);
  EXPECT_FALSE(Has(record, 3499));
  EXPECT_TRUE(Has(record, 3501));
  EXPECT_TRUE(Has(record, 15'100));
  EXPECT_FALSE(Has(record, 15'672));
}

TEST(FreeFlight, IsBesideTheCentreWhereTheRotorsPlaceIsThere) {
  Record record = Flight();
  for (auto& row : record.rows) row.sample.position_m = {-40e-6, -40e-6, -40e-6, -40e-6};
  for (std::size_t n = 0; n < 3000; ++n) record.rows[n].sample.command.control_current_a = {};
  LeaveOutContactAndWays(TheRig(), record);
  EXPECT_FALSE(Has(record, 3000));
  EXPECT_TRUE(Has(record, 9000));
}

TEST(FreeFlight, IsALargeOrbitRoundTheCentreToo) {
  Record record = Flight();
  for (std::size_t n = 0; n < kRows; ++n) {
    const double angle = 0.1 * static_cast<double>(n);
    record.rows[n].sample.position_m = {80e-6 * std::cos(angle), 80e-6 * std::sin(angle), 0, 0};
    if (n < 3000) record.rows[n].sample.command.control_current_a = {};
  }
  LeaveOutContactAndWays(TheRig(), record);
  EXPECT_TRUE(Has(record, 9000));
}

TEST(FreeFlight, IsNotEndedByASingleZeroCurrent) {
  Record record = Flight();
  record.rows[5000].sample.command.control_current_a = {};
  LeaveOutContactAndWays(TheRig(), record);
  EXPECT_EQ(record.rows.size(), kRows);
}

TEST(FreeFlight, KnowsItsOwnMeanSpeed) {
  Record record = Flight();
  for (std::size_t n = 0; n < kRows; ++n) {
    record.rows[n].sample.speed_rad_per_s = n < 10'000 ? 0.0 : 300.0;
    if (n < 10'000) record.rows[n].sample.command.control_current_a = {};
  }
  LeaveOutContactAndWays(TheRig(), record);
  EXPECT_DOUBLE_EQ(record.mean_speed_rad_per_s, 300.0);
}

}  // namespace
}  // namespace levitas::diagnosis

// What rows know of the rotation beside what was recorded.

#include "analysis/records/recorded_rows.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/random.hpp"

namespace levitas::analysis {
namespace {

constexpr double kPeriodS = 1e-4;
constexpr std::size_t kRows = 2000;

std::vector<RecordedRow> RowsAt(double (*speed_rad_per_s)(double time_s)) {
  std::vector<RecordedRow> rows(kRows);
  for (std::size_t n = 0; n < kRows; ++n) {
    rows[n].cycle = n;
    rows[n].sample.speed_rad_per_s = speed_rad_per_s(kPeriodS * static_cast<double>(n));
  }
  return rows;
}

double Acceleration(const std::vector<RecordedRow>& rows, std::size_t n) {
  return rows[n].sample.acceleration_rad_per_s2;
}

TEST(FindAccelerations, IsTheSlopeOfARamp) {
  auto rows = RowsAt([](double t) { return 50.0 + 283.0 * t; });
  FindAccelerations(kPeriodS, rows);
  for (const std::size_t n : {0U, 1U, 700U, 1999U}) EXPECT_NEAR(Acceleration(rows, n), 283.0, 1e-6);
}

TEST(FindAccelerations, IsNothingAtConstantSpeed) {
  auto rows = RowsAt([](double /*t*/) { return -314.0; });
  FindAccelerations(kPeriodS, rows);
  EXPECT_EQ(Acceleration(rows, 500), 0.0);
}

// 0.05 rad/s of noise are 500 rad/s2 from one sample to the next.
TEST(FindAccelerations, IsNotTheScatterOfTheTachometer) {
  auto rows = RowsAt([](double t) { return 50.0 + 283.0 * t; });
  Random random(7);
  for (RecordedRow& row : rows) row.sample.speed_rad_per_s += 0.05 * random.Normal();
  FindAccelerations(kPeriodS, rows);
  for (std::size_t n = 300; n < 1700; n += 100) EXPECT_NEAR(Acceleration(rows, n), 283.0, 8.0);
}

// A session has a row of the cycle before where a frame was lost.
TEST(FindAccelerations, GoesOnOverALostFrame) {
  auto rows = RowsAt([](double t) { return 50.0 + 283.0 * t; });
  for (std::size_t n = 100; n < kRows; n += 100) {
    rows[n].cycle = rows[n - 1].cycle;
    rows[n].sample.speed_rad_per_s = rows[n - 1].sample.speed_rad_per_s;
  }
  Random random(7);
  for (RecordedRow& row : rows) row.sample.speed_rad_per_s += 0.05 * random.Normal();
  FindAccelerations(kPeriodS, rows);
  for (std::size_t n = 300; n < 1700; ++n) EXPECT_NEAR(Acceleration(rows, n), 283.0, 9.0) << n;
}

// Speeds on both sides of a pause say nothing of the acceleration.
TEST(FindAccelerations, DoesNotReachAcrossAGap) {
  auto rows = RowsAt([](double t) { return t < 0.1 ? 0.0 : 300.0; });
  for (std::size_t n = 1000; n < kRows; ++n) rows[n].cycle += 5000;
  FindAccelerations(kPeriodS, rows);
  for (const std::size_t n : {999U, 1000U}) EXPECT_EQ(Acceleration(rows, n), 0.0);
}

}  // namespace
}  // namespace levitas::analysis

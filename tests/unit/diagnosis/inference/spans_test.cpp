// Parts of long records for a first answer: all of them, evenly, not more than asked for.

#include <gtest/gtest.h>

#include "diagnosis/inference/search.hpp"

namespace levitas::diagnosis {
namespace {

constexpr double kPeriod = 100e-6;

Record Rows(std::size_t count) {
  Record record;
  record.rows.resize(count);
  for (std::size_t n = 0; n < count; ++n) record.rows[n].cycle = n;
  return record;
}

TEST(Spans, OfShortRecordsAreTheRecords) {
  const auto parts = Spans({Rows(3'000), Rows(5'000)}, 10'000, kPeriod);
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].rows.size(), 3'000U);
  EXPECT_EQ(parts[1].rows.size(), 5'000U);
}

TEST(Spans, OfLongRecordsKeepTheirProportionsAndTheBudget) {
  const auto parts = Spans({Rows(60'000), Rows(120'000)}, 60'000, kPeriod);
  EXPECT_LE(parts[0].rows.size() + parts[1].rows.size(), 60'000U);
  EXPECT_EQ(parts[0].rows.size(), 20'000U);
  EXPECT_EQ(parts[1].rows.size(), 40'000U);
}

TEST(Spans, BeginAndEndWithTheRecord) {
  const auto parts = Spans({Rows(100'000)}, 40'000, kPeriod);
  EXPECT_EQ(parts[0].rows.front().cycle, 0U);
  EXPECT_EQ(parts[0].rows.back().cycle, 99'999U);
  // In order and without rows twice: the model restarts at each gap.
  for (std::size_t n = 1; n < parts[0].rows.size(); ++n) {
    ASSERT_GT(parts[0].rows[n].cycle, parts[0].rows[n - 1].cycle);
  }
}

/// 200 000 rows in which axis 2 has a test signal for 8000 of them.
Record WithASignal() {
  Record record = Rows(200'000);
  for (std::size_t n = 0; n < record.rows.size(); ++n) {
    record.rows[n].levitated = true;
    record.rows[n].sample.speed_rad_per_s = n > 150'000 ? 100.0 : 0.0;
    if (n >= 60'000 && n < 68'000) record.rows[n].excitation_a[2] = n % 2 == 0 ? 0.1 : -0.1;
  }
  return record;
}

std::size_t Excited(const Record& record) {
  std::size_t rows = 0;
  for (const auto& row : record.rows) rows += row.excitation_a[2] != 0.0 ? 1U : 0U;
  return rows;
}

TEST(QuickSpans, HoldTheTestSignalThatEvenOnesWouldMiss) {
  const auto parts = QuickSpans({WithASignal()}, kPeriod);
  EXPECT_EQ(Excited(parts[0]), 8'000U);
  EXPECT_LE(parts[0].rows.size(), kQuickRows);
  EXPECT_LT(Excited(Spans({WithASignal()}, kQuickRows, kPeriod)[0]), 1U) << "even ones miss it";
  EXPECT_EQ(parts[0].rows.back().sample.speed_rad_per_s, 100.0);
  for (std::size_t n = 1; n < parts[0].rows.size(); ++n) {
    ASSERT_GT(parts[0].rows[n].cycle, parts[0].rows[n - 1].cycle);
  }
}

// Three axes in 10 000 rows would be stretches in which the model only settles.
TEST(QuickSpans, StayEvenWhereTheyWouldBeTooShort) {
  Record record = WithASignal();
  for (std::size_t n = 80'000; n < 88'000; ++n) {
    record.rows[n].excitation_a[0] = record.rows[n + 20'000].excitation_a[1] = 0.1;
  }
  const auto parts = QuickSpans({record, record, record}, kPeriod);
  for (const Record& part : parts) {
    EXPECT_EQ(part.rows.size(), 10'000U);
    EXPECT_EQ(part.rows.back().cycle - part.rows.front().cycle, 9'999U);  // in one piece
  }
}

// The model settles for 0.3 s, which at 16 kHz is most of 6000 rows, and at 50 kHz 15 000.
TEST(QuickSpans, CountForMoreThanTheirSettlingAtAHighRate) {
  for (const double rate_hz : {16e3, 50e3}) {
    const auto settling = static_cast<std::uint64_t>(0.3 * rate_hz);
    Record record = WithASignal();
    for (std::size_t n = 100'000; n < 108'000; ++n) record.rows[n].excitation_a[0] = 0.1;
    for (const auto& part : {QuickSpans({record}, 1.0 / rate_hz).front(),
                             Spans({record}, 60'000, 1.0 / rate_hz).front()}) {
      std::uint64_t first = part.rows.front().cycle;
      for (std::size_t n = 1; n <= part.rows.size(); ++n) {
        if (n < part.rows.size() && part.rows[n].cycle == part.rows[n - 1].cycle + 1) continue;
        EXPECT_GE(part.rows[n - 1].cycle + 1 - first, settling + 2048) << rate_hz;
        if (n < part.rows.size()) first = part.rows[n].cycle;
      }
    }
  }
}

// A signal that lasts is in even stretches as it is in the record.
TEST(QuickSpans, StayEvenWhereTheSignalLasts) {
  Record record = Rows(200'000);
  for (auto& row : record.rows) {
    row.levitated = true;
    row.excitation_a[1] = 0.1;
  }
  const auto parts = QuickSpans({record}, kPeriod);
  EXPECT_EQ(parts[0].rows.front().cycle, 0U);
  EXPECT_EQ(parts[0].rows.back().cycle, 199'999U);
}

}  // namespace
}  // namespace levitas::diagnosis

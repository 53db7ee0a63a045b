// Parts of long records for a first answer: all of them, evenly, not more than asked for.

#include <gtest/gtest.h>

#include "diagnosis/inference/search.hpp"

namespace levitas::diagnosis {
namespace {

Record Rows(std::size_t count) {
  Record record;
  record.rows.resize(count);
  for (std::size_t n = 0; n < count; ++n) record.rows[n].cycle = n;
  return record;
}

TEST(Spans, OfShortRecordsAreTheRecords) {
  const auto parts = Spans({Rows(3'000), Rows(5'000)}, 10'000);
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].rows.size(), 3'000U);
  EXPECT_EQ(parts[1].rows.size(), 5'000U);
}

TEST(Spans, OfLongRecordsKeepTheirProportionsAndTheBudget) {
  const auto parts = Spans({Rows(60'000), Rows(120'000)}, 60'000);
  EXPECT_LE(parts[0].rows.size() + parts[1].rows.size(), 60'000U);
  EXPECT_EQ(parts[0].rows.size(), 20'000U);
  EXPECT_EQ(parts[1].rows.size(), 40'000U);
}

TEST(Spans, BeginAndEndWithTheRecord) {
  const auto parts = Spans({Rows(100'000)}, 40'000);
  EXPECT_EQ(parts[0].rows.front().cycle, 0U);
  EXPECT_EQ(parts[0].rows.back().cycle, 99'999U);
  // In order and without rows twice: the model restarts at each gap.
  for (std::size_t n = 1; n < parts[0].rows.size(); ++n) {
    ASSERT_GT(parts[0].rows[n].cycle, parts[0].rows[n - 1].cycle);
  }
}

}  // namespace
}  // namespace levitas::diagnosis

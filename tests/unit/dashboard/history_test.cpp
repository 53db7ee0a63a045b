#include "dashboard/history.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>

#include "batches.hpp"
#include "dashboard/spectrum_range.hpp"

namespace levitas::dashboard {
namespace {

constexpr std::size_t kAxes = 2;
constexpr std::size_t kRow = 2 + 4 * kAxes;

Envelope Bucket(double time_s) {
  Envelope bucket;
  bucket.time_s = time_s;
  bucket.low_m = {-1e-6F, -2e-6F};
  bucket.high_m = {1e-6F, 2e-6F};
  bucket.low_a = {-0.1F, -0.2F};
  bucket.high_a = {0.1F, 0.2F};
  bucket.speed_rad_per_s = 100.0 * std::numbers::pi;
  return bucket;
}

double First(const std::string& bytes) {
  double value = 0.0;
  std::memcpy(&value, bytes.data(), sizeof value);
  return value;
}

std::size_t Rows(const std::string& bytes) {
  return (bytes.size() - sizeof(double)) / (kRow * sizeof(float));
}

float At(const std::string& bytes, std::size_t row, std::size_t column) {
  float value = 0.0F;
  std::memcpy(&value, bytes.data() + sizeof(double) + (row * kRow + column) * sizeof value,
              sizeof value);
  return value;
}

TEST(History, GivesTimesSpeedsAndBothSidesOfEachChannelInTheUnitsOfThePage) {
  History history;
  history.Clear(kAxes);
  history.Add(Bucket(3.0));
  history.Add(Bucket(3.025));
  const std::string bytes = history.Bytes();
  ASSERT_EQ(Rows(bytes), 2U);
  EXPECT_EQ(First(bytes), 3.0);
  EXPECT_FLOAT_EQ(At(bytes, 1, 0), 0.025F);
  EXPECT_FLOAT_EQ(At(bytes, 1, 1), 3000.0F);  // 100 pi rad/s
  EXPECT_FLOAT_EQ(At(bytes, 1, 4), -2.0F);    // least of the second position
  EXPECT_FLOAT_EQ(At(bytes, 1, 9), 0.2F);     // greatest of the second current
}

TEST(History, DropsTheOldestBeyondTenMinutes) {
  History history;
  history.Clear(kAxes);
  constexpr double kStep = SampleStore::kBucketSeconds;
  for (std::size_t i = 0; i < History::kRows + 7; ++i) {
    history.Add(Bucket(kStep * static_cast<double>(i)));
  }
  const std::string bytes = history.Bytes();
  ASSERT_EQ(Rows(bytes), History::kRows);
  EXPECT_DOUBLE_EQ(First(bytes), 7 * kStep);
  EXPECT_FLOAT_EQ(At(bytes, History::kRows - 1, 0),
                  static_cast<float>(kStep * static_cast<double>(History::kRows - 1)));
  EXPECT_NEAR(static_cast<double>(History::kRows) * kStep, 600.0, 1e-6);
}

TEST(History, WritesABucketWithoutAReadingAsNoNumber) {
  History history;
  history.Clear(kAxes);
  Envelope bucket = Bucket(1.0);
  bucket.low_m[0] = std::numeric_limits<float>::infinity();
  bucket.high_m[0] = -std::numeric_limits<float>::infinity();
  history.Add(bucket);
  EXPECT_TRUE(std::isnan(At(history.Bytes(), 0, 2)));
  EXPECT_TRUE(std::isnan(At(history.Bytes(), 0, 3)));
  EXPECT_FLOAT_EQ(At(history.Bytes(), 0, 4), -2.0F);
}

TEST(History, ForgetsTheRunBeforeAndTakesNothingOfOneThatWasNotAnnounced) {
  History history;
  history.Add(Bucket(1.0));
  EXPECT_TRUE(history.Bytes().empty());
  history.Clear(kAxes);
  EXPECT_TRUE(history.Bytes().empty());
  history.Add(Bucket(1.0));
  history.Clear(kAxes);
  EXPECT_TRUE(history.Bytes().empty());
}

TEST(SampleStore, TellsEachBucketAsItClosesWhetherOrNotSomebodyTakesIt) {
  std::vector<double> closed_s;
  SampleStore store(SmallRig(), [&](const Envelope& bucket) { closed_s.push_back(bucket.time_s); });
  ASSERT_TRUE(store.Add(Batch(0, 600, [](std::int64_t, int) { return 0.0; })));
  EXPECT_EQ(closed_s, (std::vector{249 * 1e-4, 499 * 1e-4}));
  EXPECT_EQ(store.TakeEnvelopes().size(), 2U);
}

TEST(SpectrumRange, IsWhatWasAskedForLast) {
  SpectrumRange range(500.0);
  EXPECT_EQ(range.highest_hz(), 500.0);
  EXPECT_EQ(range.Ask(R"({"highest_hz": 1000})").status, kHttpOk);
  EXPECT_EQ(range.highest_hz(), 1000.0);
}

TEST(SpectrumRange, RefusesWhatIsNoRangeAndKeepsTheOneItHas) {
  SpectrumRange range(500.0);
  for (const char* body : {"", "[]", "{}", R"({"highest_hz": 0})", R"({"highest_hz": "wide"})",
                           R"({"highest_hz": 1e9})", R"({"highest_hz": 100, "lowest_hz": 1})"}) {
    EXPECT_EQ(range.Ask(body).status, kHttpBadRequest) << body;
  }
  EXPECT_EQ(range.highest_hz(), 500.0);
}

}  // namespace
}  // namespace levitas::dashboard

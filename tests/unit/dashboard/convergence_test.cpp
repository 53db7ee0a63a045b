// The page's history of an online identification.
#include "dashboard/convergence.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

namespace levitas::dashboard {
namespace {

constexpr std::int64_t kStart = 7;
constexpr double kPeriod = 1e-4;

std::vector<std::uint8_t> Point(std::int64_t rows, double change, std::int64_t start = kStart) {
  levitas_msg::convergence_t point{};
  point.start_utc_ns = start;
  point.cycle = rows + 5000;
  point.rows = rows;
  point.change = change;
  point.tolerance = 0.01;
  point.converged = change <= 0.01 ? 1 : 0;
  point.outputs = 2;
  point.error_rms_m = {1e-7, 2e-7};
  point.fit_percent = {99.0, std::numeric_limits<double>::quiet_NaN()};
  point.changed = "constant for ux";
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(point.getEncodedSize()));
  point.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

nlohmann::json Told(const ConvergenceHistory& history) {
  return nlohmann::json::parse(history.Json());
}

TEST(Convergence, TellsThePageItsHistoryInTheOrderItCame) {
  ConvergenceHistory history;
  history.RunIs(kStart, kPeriod);
  bool told = false;
  EXPECT_TRUE(history.Take(Point(10'000, 0.5), told));
  EXPECT_TRUE(told);
  EXPECT_TRUE(history.Take(Point(20'000, 0.008), told));
  const nlohmann::json json = Told(history);
  EXPECT_EQ(json["t_s"], (std::vector<double>{1.5, 2.5}));
  EXPECT_NEAR(json["change_percent"][0].get<double>(), 50.0, 1e-9);
  EXPECT_NEAR(json["change_percent"][1].get<double>(), 0.8, 1e-9);
  EXPECT_NEAR(json["error_um"][1].get<double>(), 0.2, 1e-9);
  EXPECT_TRUE(json["fit_percent"][1][0].is_null());
  EXPECT_TRUE(json["converged"].get<bool>());
  EXPECT_EQ(json["rows"], 20'000);
}

TEST(Convergence, OfAnotherRunIsLeftOut) {
  ConvergenceHistory history;
  bool told = true;
  EXPECT_TRUE(history.Take(Point(10'000, 0.5), told));  // no header yet
  EXPECT_FALSE(told);
  history.RunIs(kStart, kPeriod);
  EXPECT_TRUE(history.Take(Point(10'000, 0.5, kStart + 1), told));
  EXPECT_FALSE(told);
  EXPECT_TRUE(history.Take(Point(10'000, 0.5), told));
  history.RunIs(kStart + 1, kPeriod);
  EXPECT_EQ(history.Json(), "{}");
  EXPECT_TRUE(history.Take(Point(20'000, 0.5), told));  // late, of the run before
  EXPECT_FALSE(told);
  EXPECT_TRUE(history.Take(Point(500, 0.5, kStart + 1), told));
  EXPECT_TRUE(told);
  EXPECT_EQ(Told(history)["t_s"].size(), 1U);
  EXPECT_EQ(Told(history)["rows"], 500);
}

TEST(Convergence, BegunAnewBeginsAnotherHistory) {
  ConvergenceHistory history;
  history.RunIs(kStart, kPeriod);
  bool told = false;
  for (const std::int64_t rows : {10'000, 20'000, 10'000}) {
    EXPECT_TRUE(history.Take(Point(rows, 0.5), told));
  }
  EXPECT_EQ(Told(history)["t_s"].size(), 1U);
}

TEST(Convergence, KeepsTheNewestPointsAndNoMore) {
  ConvergenceHistory history;
  history.RunIs(kStart, kPeriod);
  bool told = false;
  constexpr auto kPoints = static_cast<std::int64_t>(ConvergenceHistory::kMost) + 5;
  for (std::int64_t i = 1; i <= kPoints; ++i) EXPECT_TRUE(history.Take(Point(i, 0.5), told));
  const nlohmann::json json = Told(history);
  EXPECT_EQ(json["t_s"].size(), ConvergenceHistory::kMost);
  EXPECT_EQ(json["rows"], kPoints);
  EXPECT_NEAR(json["t_s"][0].get<double>(), (5000 + 6) * kPeriod, 1e-3);  // five were dropped
}

TEST(Convergence, RefusesBytesThatAreNoMessageAndKeepsWhatItHad) {
  ConvergenceHistory history;
  history.RunIs(kStart, kPeriod);
  bool told = false;
  EXPECT_TRUE(history.Take(Point(10'000, 0.5), told));
  const std::string before = history.Json();
  const std::vector<std::uint8_t> whole = Point(20'000, 0.5);
  for (std::size_t bytes = 0; bytes < whole.size(); ++bytes) {
    told = true;
    EXPECT_FALSE(history.Take(std::span(whole).first(bytes), told)) << bytes;
    EXPECT_FALSE(told) << bytes;
  }
  std::vector<std::uint8_t> other = whole;
  other[0] ^= 1U;  // the type's fingerprint comes first
  EXPECT_FALSE(history.Take(other, told));
  EXPECT_EQ(history.Json(), before);
}

}  // namespace
}  // namespace levitas::dashboard

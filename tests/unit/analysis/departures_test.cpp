#include "analysis/records/departures.hpp"

#include <gtest/gtest.h>

namespace levitas::analysis {
namespace {

/// A channel whose unexplained power is all in its 1x.
ChannelReport WithOnce(double multiple, double expected, double ratio) {
  ChannelReport report;
  report.multiple = multiple;
  report.expected_multiple = expected;
  report.orders = {{1, 1e-6, ratio, 1.0}};
  return report;
}

// All of next to nothing is less than most of a probe that is turned round.
TEST(Departures, BeginWithTheChannelThatIsFurthestFromItsNoise) {
  ChannelReport wrong = WithOnce(30.0, 1.06, 15.0);
  wrong.orders.front().share = 0.7;
  const auto departures = Departures({WithOnce(1.07, 1.06, 2.2), wrong});
  ASSERT_EQ(departures.size(), 2U);
  EXPECT_EQ(departures[0].channel, 1U);
  EXPECT_EQ(departures[1].channel, 0U);
}

TEST(Departures, OfOneChannelAreInTheOrderOfTheirShares) {
  ChannelReport report = WithOnce(5.0, 1.0, 3.0);
  report.orders.front().share = 0.2;
  report.orders.push_back({2, 1e-6, 4.0, 0.6});
  const auto departures = Departures({report});
  ASSERT_EQ(departures.size(), 2U);
  EXPECT_EQ(departures[0].place, "2x of rotation");
}

}  // namespace
}  // namespace levitas::analysis

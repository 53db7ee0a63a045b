// A hum so loud that a whitening filter would take it for coloured noise.

#include "diagnosis/inference/loud_fault.hpp"

#include <gtest/gtest.h>

#include "tests/unit/diagnosis/hum.hpp"

namespace levitas::diagnosis {
namespace {

// 5 um in 1 um of noise: rms 3.7 times the noise, of which a filter leaves about the noise.
TEST(TakeLoudFault, TakesTheHumThatTheFilterHidesWithItsAmplitude) {
  constexpr double kHum = 5e-6;
  HumSearch hum(kHum);
  hum.found.refitted.resize(1);
  ASSERT_TRUE(TakeLoudFault(hum.landscape, hum.rules, hum.found));
  ASSERT_EQ(hum.found.causes.size(), 1U);
  EXPECT_EQ(hum.found.causes[0].effect, "mains_pickup");
  EXPECT_NEAR(hum.AmplitudeOnDeX(), kHum, HumTolerance());
  EXPECT_TRUE(hum.found.refitted.empty()) << "weighed by the filter that hid it";
}

TEST(TakeLoudFault, LeavesAllAsItWasWhereNothingIsLoud) {
  HumSearch quiet(0.0);
  quiet.found.refitted.resize(1);
  const std::vector<double> before = quiet.found.theta;
  EXPECT_FALSE(TakeLoudFault(quiet.landscape, quiet.rules, quiet.found));
  EXPECT_TRUE(quiet.found.causes.empty());
  EXPECT_EQ(quiet.found.theta, before);
  EXPECT_EQ(quiet.found.refitted.size(), 1U);
  EXPECT_EQ(quiet.landscape.view().theta, before);
}

TEST(TakeLoudFault, LeavesALoudHumWhoseWorthNoAnswerCanReach) {
  HumSearch hum(5e-6);
  hum.rules.judging.suspected_nat = 1e9;
  const std::vector<double> before = hum.found.theta;
  EXPECT_FALSE(TakeLoudFault(hum.landscape, hum.rules, hum.found));
  EXPECT_TRUE(hum.found.causes.empty());
  EXPECT_EQ(hum.found.theta, before);
  EXPECT_EQ(hum.landscape.view().theta, before) << "linearised where it was";
}

}  // namespace
}  // namespace levitas::diagnosis

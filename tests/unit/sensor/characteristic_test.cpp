#include "plant_sim/sensor/characteristic.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace levitas::sensor {
namespace {

using testing::HasSubstr;

std::string Refusal(const std::vector<ProbePoint>& points) {
  try {
    CheckCharacteristic("curve", points);
  } catch (const std::invalid_argument& refused) {
    return refused.what();
  }
  return {};
}

/// Points of an eddy current probe that loses slope with distance: r = p + a2 p^2, exact.
std::vector<ProbePoint> Bent(double a2_1_per_m, double step_m, int points_to_a_side) {
  std::vector<ProbePoint> points;
  for (int i = -points_to_a_side; i <= points_to_a_side; ++i) {
    const double p = i * step_m;
    points.push_back({p, p + a2_1_per_m * p * p});
  }
  return points;
}

TEST(Characteristic, WithoutPointsIsAStraightLine) {
  const Characteristic curve;
  EXPECT_TRUE(curve.straight());
  EXPECT_EQ(curve(123e-6), 123e-6);
  EXPECT_EQ(curve.SlopeAtCentre(), 1.0);
}

TEST(Characteristic, PassesThroughItsPointsAndIsMonotoneBetween) {
  // A step of the slope by ten, which a plain cubic would overshoot.
  const Characteristic curve({{-2e-4, -2e-3}, {0, 0}, {1e-4, 1e-5}, {2e-4, 2e-5}, {3e-4, 1e-3}});
  EXPECT_EQ(curve(1e-4), 1e-5);
  EXPECT_EQ(curve(-2e-4), -2e-3);
  double before = curve(-2.5e-4);
  for (double p = -2.49e-4; p < 3.5e-4; p += 1e-6) {
    EXPECT_GT(curve(p), before) << p;
    before = curve(p);
  }
}

TEST(Characteristic, FollowsTheCurveThatWasMeasured) {
  const double a2 = 500.0;  // 5 % at 100 um
  const Characteristic curve(Bent(a2, 20e-6, 10));
  for (double p = -180e-6; p < 180e-6; p += 3e-6) {
    // The harmonic mean of two chords that differ by 2 a2 h is low by (a2 h)^2 = 1e-4 of the slope,
    // which a cubic carries on over a quarter of the step.
    EXPECT_NEAR(curve(p), p + a2 * p * p, 2e-4 * 20e-6) << p;
  }
  EXPECT_NEAR(curve.SlopeAtCentre(), 1.0, 1.1 * std::pow(a2 * 20e-6, 2));
}

TEST(Characteristic, GoesOnStraightBeyondItsTable) {
  const Characteristic curve({{-1e-4, -1e-4}, {0, 0}, {1e-4, 5e-5}});
  EXPECT_NEAR(curve(3e-4), 5e-5 + 2e-4 * 0.5, 1e-18);
  EXPECT_NEAR(curve(-3e-4), -3e-4, 1e-18);
}

TEST(Characteristic, HasTheHarmonicMeanOfUnequalChordsAtTheCentre) {
  // Equal steps: 2/(1/1 + 1/0.5).
  const Characteristic curve({{-1e-4, -1e-4}, {0, 0}, {1e-4, 5e-5}});
  EXPECT_NEAR(curve.SlopeAtCentre(), 2.0 / 3.0, 1e-15);
}

TEST(CheckCharacteristic, RefusesWhatNoProbeReads) {
  EXPECT_EQ(Refusal({}), "");
  EXPECT_EQ(Refusal({{-1e-4, -1e-4}, {0, 0}, {1e-4, 1e-4}}), "");
  EXPECT_THAT(Refusal({{0, 0}}), HasSubstr("two or more points"));
  EXPECT_THAT(Refusal({{-1e-4, -1e-4}, {0, 0}, {1e-4, -1e-6}}), HasSubstr("ascend"));
  EXPECT_THAT(Refusal({{0, 0}, {0, 1e-4}}), HasSubstr("ascend"));
  EXPECT_THAT(Refusal({{0, 0}, {1e-4, std::numeric_limits<double>::quiet_NaN()}}),
              HasSubstr("ascend"));
  EXPECT_THAT(Refusal({{-1e-4, -1e-4}, {1e-4, 1e-4}}), HasSubstr("centre"));
}

}  // namespace
}  // namespace levitas::sensor

#include "plant_sim/sensor/sensor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace levitas::sensor {
namespace {

constexpr double kRate = 2.0 * std::numbers::pi * 5000.0;

TEST(FilterStep, FollowsARampExactlyWhateverTheStep) {
  // s' = (t - s)/tau from rest: s(t) = t - tau (1 - e^{-t/tau})
  for (const int steps : {1, 3, 50}) {
    const double h = 200e-6 / steps;
    const FilterStep filter = MakeFilterStep(5000.0, 1.0, h);
    double s = 0.0;
    for (int i = 0; i < steps; ++i)
      s = filter.decay * s + filter.start * i * h + filter.end * (i + 1) * h;
    const double expected = 200e-6 + std::expm1(-kRate * 200e-6) / kRate;
    EXPECT_NEAR(s, expected, 1e-15) << steps;  // rounding on 2e-4
  }
}

TEST(FilterStep, KeepsAConstantTimesItsGain) {
  const FilterStep filter = MakeFilterStep(5000.0, 1.25, 25e-6);
  EXPECT_NEAR(filter.decay * 1.25 + filter.start + filter.end, 1.25, 1e-15);
}

TEST(FilterStep, ChangesSmoothlyWhereTheSeriesTakesOver) {
  // Both forms at the same argument, 1e-4: the closed form loses 12 digits of 16 there.
  const double bandwidth_hz = 1e-4 / (2.0 * std::numbers::pi);
  const double below = MakeFilterStep(bandwidth_hz, 1.0, 0.999999).end;
  const double above = MakeFilterStep(bandwidth_hz, 1.0, 1.000001).end;
  EXPECT_NEAR(below / above, 0.999998, 1e-9);
  EXPECT_NEAR(below / 0.5e-4, 1.0, 1e-4);
}

TEST(Convert, RoundsToTheNearestStep) {
  const Converter converter{0.0, 1e-6, 400e-6};
  EXPECT_DOUBLE_EQ(Convert(converter, 3.4e-6, 0.0), 3e-6);
  EXPECT_DOUBLE_EQ(Convert(converter, -3.6e-6, 0.0), -4e-6);
}

TEST(Convert, ClipsAtItsRangeOnBothSides) {
  const Converter converter{0.0, 0.0, 400e-6};
  EXPECT_EQ(Convert(converter, 1.0, 0.0), 400e-6);
  EXPECT_EQ(Convert(converter, -1.0, 0.0), -400e-6);
  EXPECT_EQ(Convert({}, 1.0, 0.0), 1.0);  // no range: nothing is clipped
}

TEST(Convert, AddsNoiseBeforeItRounds) {
  const Converter converter{2e-6, 1e-6, 400e-6};
  EXPECT_DOUBLE_EQ(Convert(converter, 0.0, 1.6), 3e-6);
}

}  // namespace
}  // namespace levitas::sensor

#include "identification/frf/flat_top.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/random.hpp"

namespace levitas::identification {
namespace {

std::vector<double> Noise(double step) {
  Random random(20261122);
  std::vector<double> values(20'000);
  for (double& value : values) value = step * std::round(random.Normal() / step);
  return values;
}

TEST(FlatTop, NoiseOnACoarseConverterHasNone) {
  // A twentieth of a standard deviation, and one: seven values in all.
  for (const double step : {0.05, 1.0}) EXPECT_EQ(FlatShare(Noise(step)), 0.0) << step;
}

TEST(FlatTop, ASineOnACoarseConverterHasNone) {
  std::vector<double> values(20'000);
  for (std::size_t n = 0; n < values.size(); ++n) {
    values[n] = std::round(50.0 * std::sin(0.0123 * static_cast<double>(n)));
  }
  EXPECT_EQ(FlatShare(values), 0.0);
}

TEST(FlatTop, WhatACutTakesOfNoiseIsItsShare) {
  for (const bool top : {true, false}) {
    std::vector<double> values = Noise(0.05);
    std::size_t beyond = 0;
    for (double& value : values) {
      if (top ? value >= 1.0 : value <= -1.0) ++beyond;
      value = top ? std::min(value, 1.0) : std::max(value, -1.0);
    }
    EXPECT_DOUBLE_EQ(FlatShare(values), static_cast<double>(beyond) / 20'000.0);
  }
}

TEST(FlatTop, ADeadSignalIsNotClipped) { EXPECT_EQ(FlatShare(std::vector<double>(100, 1.0)), 0.0); }

}  // namespace
}  // namespace levitas::identification

#include "common/histogram.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "common/random.hpp"

namespace levitas {
namespace {

TEST(Histogram, PercentilesLieWithinOneBinOfTheSortedValues) {
  Random draw{20261121};
  Histogram histogram;
  std::vector<double> values;
  for (int i = 0; i < 20'000; ++i) {
    const double value = std::floor(std::exp(draw.Uniform() * 16.0));
    values.push_back(value);
    histogram.Add(static_cast<std::int64_t>(value));
  }
  std::sort(values.begin(), values.end());
  for (const double p : {0.5, 0.9, 0.99, 0.999}) {
    const double exact = values[static_cast<std::size_t>(p * 20'000.0) - 1];
    EXPECT_GE(histogram.Percentile(p), exact);
    EXPECT_LE(histogram.Percentile(p), exact * 17.0 / 16.0 + 1.0);  // 16 bins per octave
  }
  EXPECT_EQ(histogram.count(), 20'000U);
}

TEST(Histogram, KeepsNegativeAndHugeDurations) {
  Histogram histogram;
  histogram.Add(-5);
  histogram.Add(std::int64_t{1} << 50);
  EXPECT_EQ(histogram.count(), 2U);
  EXPECT_EQ(histogram.max_ns(), std::int64_t{1} << 50);
  EXPECT_EQ(histogram.bins().front(), 1U);
  EXPECT_EQ(histogram.bins().back(), 1U);
}

TEST(Histogram, IsZeroWhenEmpty) { EXPECT_EQ(Histogram{}.Percentile(0.99), 0.0); }

}  // namespace
}  // namespace levitas

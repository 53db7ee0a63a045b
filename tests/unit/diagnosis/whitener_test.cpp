// Whitening: what is left of a coloured signal is white and of unit variance.

#include <gtest/gtest.h>

#include "diagnosis/model/normal_equations.hpp"
#include "tests/unit/diagnosis/trajectories.hpp"

namespace levitas::diagnosis {
namespace {

/// Innovations that remember 0.8 of the one before.
Trajectory Coloured(std::uint64_t seed) {
  AxisFloats before{};
  return NoiseRun(seed, 20'000, [&before](std::size_t, SamplePoint& m) {
    for (std::size_t a = 0; a < View().axes; ++a) {
      m.innovation_m[a] += 0.8F * before[a];
      before[a] = m.innovation_m[a];
    }
  });
}

TEST(WhitenerTest, OfOrderZeroScalesAlone) {
  const Whitener whitener = MakeWhitener({NoiseRun(1, 20'000)}, View().axes, 0);
  for (const auto& filter : whitener.filter) {
    ASSERT_EQ(filter.size(), 1U);
    EXPECT_NEAR(filter[0] * kNoise, 1.0, 0.02);
  }
}

TEST(WhitenerTest, FindsTheFilterThatMadeTheColour) {
  const Whitener whitener = MakeWhitener({Coloured(2)}, View().axes, 2);
  for (const auto& filter : whitener.filter) {
    ASSERT_EQ(filter.size(), 3U);
    EXPECT_NEAR(filter[0] * kNoise, 1.0, 0.02);
    EXPECT_NEAR(filter[1] / filter[0], -0.8, 0.03);  // 1/sqrt(20000) is 0.007
    EXPECT_NEAR(filter[2] / filter[0], 0.0, 0.03);
  }
}

TEST(WhitenerTest, LeavesUnitVariance) {
  const std::vector<Trajectory> runs{Coloured(3)};
  const Whitener whitener = MakeWhitener(runs, View().axes, 4);
  std::size_t values = 0;
  const double sum = SquaredSum(runs, View().axes, whitener, &values);
  EXPECT_GT(values, 79'000U);
  EXPECT_NEAR(sum / static_cast<double>(values), 1.0, 0.02);
}

}  // namespace
}  // namespace levitas::diagnosis

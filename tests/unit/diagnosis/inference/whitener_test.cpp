// Whitening: what is left of a coloured signal is white and of unit variance.

#include <gtest/gtest.h>

#include <cmath>

#include "diagnosis/inference/calibrate.hpp"
#include "diagnosis/model/normal_equations.hpp"
#include "tests/unit/diagnosis/trajectories.hpp"

namespace levitas::diagnosis {
namespace {

/// Innovations that remember 0.8 of the one before.
Trajectory Coloured(std::uint64_t seed) {
  AxisFloats before{};
  return NoiseRun(seed, 20'000, [&before](std::size_t, SamplePoint& m) {
    for (std::size_t a = 0; a < TheRig().axes; ++a) {
      m.innovation_m[a] += 0.8F * before[a];
      before[a] = m.innovation_m[a];
    }
  });
}

TEST(WhitenerTest, OfOrderZeroScalesAlone) {
  const Whitener whitener = MakeWhitener({NoiseRun(1, 20'000)}, TheRig().axes, 0);
  for (const auto& filter : whitener.filter) {
    ASSERT_EQ(filter.size(), 1U);
    EXPECT_NEAR(filter[0] * kNoise, 1.0, 0.02);
  }
}

TEST(WhitenerTest, FindsTheFilterThatMadeTheColour) {
  const Whitener whitener = MakeWhitener({Coloured(2)}, TheRig().axes, 2);
  for (const auto& filter : whitener.filter) {
    ASSERT_EQ(filter.size(), 3U);
    EXPECT_NEAR(filter[0] * kNoise, 1.0, 0.02);
    EXPECT_NEAR(filter[1] / filter[0], -0.8, 0.03);  // 1/sqrt(20000) is 0.007
    EXPECT_NEAR(filter[2] / filter[0], 0.0, 0.03);
  }
}

TEST(WhitenerTest, LeavesUnitVariance) {
  const std::vector<Trajectory> runs{Coloured(3)};
  const Whitener whitener = MakeWhitener(runs, TheRig().axes, 4);
  std::size_t values = 0;
  const double sum = SquaredSum(runs, TheRig().axes, whitener, &values);
  EXPECT_GT(values, 79'000U);
  EXPECT_NEAR(sum / static_cast<double>(values), 1.0, 0.02);
}

/// Noise on a channel that swings about a place far out.
Trajectory Swinging(double amplitude_m) {
  return NoiseRun(5, 20'000, [amplitude_m](std::size_t n, SamplePoint& m) {
    for (float& measured : m.measured_m) {
      measured = static_cast<float>(1e-3 + amplitude_m * std::sin(0.1 * static_cast<double>(n)));
    }
  });
}

TEST(WhitenerTest, TakesNoChannelForQuieterThanAShareOfItsMotion) {
  constexpr double kShare = 0.01;
  const double amplitude_m = 300.0 * kNoise;
  const Whitener whitener = MakeWhitener({Swinging(amplitude_m)}, TheRig().axes, 2, kShare);
  for (const auto& filter : whitener.filter) {
    EXPECT_NEAR(filter[0] * kShare * amplitude_m / std::sqrt(2.0), 1.0, 0.01);
  }
}

TEST(WhitenerTest, LeavesANoisyChannelAlone) {
  const std::vector<Trajectory> runs{Swinging(50.0 * kNoise)};
  EXPECT_EQ(MakeWhitener(runs, TheRig().axes, 2, 0.01).filter,
            MakeWhitener(runs, TheRig().axes, 2).filter);
}

/// What an observer leaves that follows its readings too closely: white noise less a slow mean of
/// what came before. Its correlation at lag 1 is about -0.04.
Trajectory SlowlyColoured(std::uint64_t seed) {
  AxisFloats mean{};
  return NoiseRun(seed, 40'000, [&mean](std::size_t, SamplePoint& m) {
    for (std::size_t a = 0; a < TheRig().axes; ++a) {
      const float white = m.innovation_m[a];
      m.innovation_m[a] -= 0.04F * mean[a];
      mean[a] = 0.9F * mean[a] + white;
    }
  });
}

/// Variance of sums over 200 samples of what a filter of this order leaves, over that of white
/// noise of unit variance: what a likelihood takes slow changes for.
double SlowVariance(const Trajectory& run, std::size_t order) {
  constexpr std::size_t kRows = 200;
  const Whitener whitener = MakeWhitener({run}, TheRig().axes, order);
  double squares = 0.0;
  double count = 0.0;
  for (std::size_t a = 0; a < whitener.filter.size(); ++a) {
    for (std::size_t first = order; first + kRows <= run.moments.size(); first += kRows) {
      double sum = 0.0;
      for (std::size_t n = first; n < first + kRows; ++n) {
        for (std::size_t k = 0; k <= order; ++k) {
          sum += whitener.filter[a][k] * static_cast<double>(run.moments[n - k].innovation_m[a]);
        }
      }
      squares += sum * sum;
      count += static_cast<double>(kRows);
    }
  }
  return squares / count;
}

TEST(WhitenerTest, OfADiagnosisLeavesNoSlowColour) {
  // Four axes of two hundred sums: chance makes sqrt(2/800) = 0.05 of their variance.
  const Trajectory run = SlowlyColoured(4);
  EXPECT_LT(SlowVariance(run, 4), 0.7);
  EXPECT_NEAR(SlowVariance(run, kWhiteningOrder), 1.0, 0.2);
}

}  // namespace
}  // namespace levitas::diagnosis

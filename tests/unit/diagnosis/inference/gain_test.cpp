// The gain of an extension against what was put into the innovations.

#include "diagnosis/inference/gain.hpp"

#include <gtest/gtest.h>

#include "tests/unit/diagnosis/trajectories.hpp"

namespace levitas::diagnosis {
namespace {

constexpr std::size_t kGainSamples = 30'000;

/// The same noise with an error of `size` times its power on every axis.
Trajectory Error(double size, std::uint64_t seed = 3) {
  return NoiseRun(seed, kGainSamples, [size](std::size_t, SamplePoint& m) {
    for (std::size_t a = 0; a < TheRig().axes; ++a) {
      m.innovation_m[a] += static_cast<float>(Sine(kNoise * std::sqrt(2.0 * size), 91.0, m.time_s));
    }
  });
}

const std::vector<double>& NoiseOfAxes() {
  static const std::vector<double> kLevels(TheRig().axes, kNoise);
  return kLevels;
}

TEST(GainTest, OfAnExtensionThatExplainsAllIsOne) {
  const Gain gain = MeasureGain(TheRig(), {{Error(2.0)}, {Error(1.0)}, {Error(0.0)}}, NoiseOfAxes(),
                                Part::kFitted);
  EXPECT_NEAR(gain.achieved.value, 1.0, 0.02);
  EXPECT_NEAR(gain.beyond_calibration.value, 1.0, 0.03);
  EXPECT_LE(gain.achieved.low, gain.achieved.value);
  EXPECT_GE(gain.achieved.high, gain.achieved.value);
}

TEST(GainTest, IsTheShareOfTheAchievablePower) {
  // From 2 to 0.5 of the noise's power: 1.5 of 2; from the calibrated 1 to 0.5: a half.
  const Gain gain = MeasureGain(TheRig(), {{Error(2.0)}, {Error(1.0)}, {Error(0.5)}}, NoiseOfAxes(),
                                Part::kFitted);
  EXPECT_NEAR(gain.achieved.value, 0.75, 0.02);
  EXPECT_NEAR(gain.beyond_calibration.value, 0.5, 0.03);
  ASSERT_EQ(gain.channel.size(), TheRig().axes);
  for (const Share& channel : gain.channel) {
    EXPECT_NEAR(channel.value, 0.75, 0.03);
    EXPECT_LT(channel.low, channel.high);
  }
}

TEST(GainTest, TellsWhatThereWasToGainInPowersOfTheNoise) {
  const Gain gain = MeasureGain(TheRig(), {{Error(2.0)}, {Error(1.0)}, {Error(0.0)}}, NoiseOfAxes(),
                                Part::kFitted);
  EXPECT_NEAR(gain.to_gain.value, 2.0, 0.05);
  EXPECT_NEAR(gain.calibrated_over_noise, 2.0, 0.04);
  EXPECT_NEAR(gain.extended_over_noise, 1.0, 0.02);
  EXPECT_TRUE(SomethingToGain(gain));
  // A rig that its file describes: a share of nothing means nothing, whatever it comes to.
  EXPECT_FALSE(SomethingToGain(MeasureGain(TheRig(), {{Error(0.0)}, {Error(0.0)}, {Error(0.1)}},
                                           NoiseOfAxes(), Part::kFitted)));
}

TEST(GainTest, IsNegativeWhenTheExtensionIsWorse) {
  const Gain gain = MeasureGain(TheRig(), {{Error(1.0)}, {Error(1.0)}, {Error(1.5)}}, NoiseOfAxes(),
                                Part::kFitted);
  EXPECT_NEAR(gain.achieved.value, -0.5, 0.03);
  EXPECT_LT(gain.achieved.high, 0.0);
}

TEST(GainTest, FitIsThatOfTheInnovationsAndTheCeilingThatOfTheNoise) {
  const Gain gain = MeasureGain(TheRig(), {{Error(3.0)}, {Error(3.0)}, {Error(0.0)}}, NoiseOfAxes(),
                                Part::kFitted);
  const double spread = 20e-6 / std::sqrt(2.0);  // of what was measured, a sine
  EXPECT_NEAR(gain.nominal_percent, 100.0 * (1.0 - 2.0 * kNoise / spread), 0.2);
  EXPECT_NEAR(gain.ceiling_percent, 100.0 * (1.0 - kNoise / spread), 0.1);
  EXPECT_NEAR(gain.extended_percent, gain.ceiling_percent, 0.1);
}

TEST(GainTest, IsMeasuredOnThePartAskedForAlone) {
  const auto halves = [](double first, double second) {
    Trajectory run = Error(first);
    const Trajectory other = Error(second);
    for (std::size_t n = kGainSamples / 2; n < kGainSamples; ++n) {
      run.moments[n] = other.moments[n];
      run.moments[n].counts = false;
      run.moments[n].held = true;
    }
    return run;
  };
  const ModelRuns runs{{halves(2.0, 2.0)}, {halves(2.0, 2.0)}, {halves(0.0, 1.0)}};
  EXPECT_NEAR(MeasureGain(TheRig(), runs, NoiseOfAxes(), Part::kFitted).achieved.value, 1.0, 0.03);
  EXPECT_NEAR(MeasureGain(TheRig(), runs, NoiseOfAxes(), Part::kValidation).achieved.value, 0.5,
              0.03);
}

TEST(GainTest, OfNothingMeasuredIsNothing) {
  const ModelRuns runs{{Trajectory{}}, {Trajectory{}}, {Trajectory{}}};
  const Gain gain = MeasureGain(TheRig(), runs, NoiseOfAxes(), Part::kValidation);
  EXPECT_EQ(gain.achieved.value, 0.0);
  EXPECT_EQ(gain.nominal_percent, 0.0);
}

}  // namespace
}  // namespace levitas::diagnosis

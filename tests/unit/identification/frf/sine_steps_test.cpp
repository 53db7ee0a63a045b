// Sines held one after the other are read off the signal: frequencies, where each begins and ends,
// and what is no such signal.
#include "identification/frf/sine_steps.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "controller/scenario/signal.hpp"

namespace levitas::identification {
namespace {

constexpr double kPeriodS = 1e-4;

scenario::Excitation SteppedSine() {
  scenario::Excitation e;
  e.kind = scenario::SignalKind::kSteppedSine;
  e.from_hz = 10.0;
  e.to_hz = 1000.0;
  e.frequencies = 25;
  e.dwell_s = 0.4;
  return e;
}

/// The player gives the signal from the first sample that is not zero.
std::vector<double> Play(const scenario::Excitation& config, double time_s) {
  scenario::Signal signal(config, kPeriodS);
  std::vector<double> samples;
  const auto count = static_cast<std::size_t>(std::lround(time_s / kPeriodS));
  samples.reserve(count);
  while (samples.size() < count) {
    const double value = 0.2 * signal.Next();
    if (!samples.empty() || value != 0.0) samples.push_back(value);
  }
  return samples;
}

TEST(SineSteps, AreThoseOfTheScenario) {
  const auto steps = FindSineSteps(Play(SteppedSine(), 25 * 0.4));
  ASSERT_EQ(steps.size(), 25U);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    // Equal ratios from 10 to 1000 Hz. The frequency is fitted to 4000 samples without noise; what
    // a few samples of the neighbour may add is 1e-3 of the amplitude in a phase of 25 rad or more.
    const double f_hz = 10.0 * std::pow(100.0, static_cast<double>(i) / 24.0);
    EXPECT_NEAR(steps[i].cycles_per_sample / kPeriodS, f_hz, 1e-5 * f_hz) << i;
    EXPECT_NEAR(std::abs(steps[i].amplitude), 0.2, 1e-4) << i;
    // A step is left where its neighbour departs by a thousandth of the amplitude: at 21 % between
    // frequencies that is within a hundredth of a period, ten samples at 10 Hz.
    EXPECT_NEAR(static_cast<double>(steps[i].begin), 4000.0 * static_cast<double>(i), 12.0) << i;
  }
}

TEST(SineSteps, AreFoundThoughAFileRounds) {
  auto samples = Play(SteppedSine(), 25 * 0.4);
  for (double& value : samples) value = 1e-6 * std::round(1e6 * value);
  EXPECT_EQ(FindSineSteps(samples).size(), 25U);
}

TEST(SineSteps, AreNoneInAPseudoRandomSequence) {
  scenario::Excitation prbs;
  prbs.order = 9;
  prbs.divisor = 2;
  EXPECT_TRUE(FindSineSteps(Play(prbs, 0.2)).empty());
}

TEST(SineSteps, AreNoneInAMultisineNorInStrokes) {
  scenario::Excitation multisine;
  multisine.kind = scenario::SignalKind::kMultisine;
  multisine.from_hz = 5.0;
  multisine.to_hz = 500.0;
  multisine.repeat_s = 0.4;
  EXPECT_TRUE(FindSineSteps(Play(multisine, 1.6)).empty());
  scenario::Excitation strokes;
  strokes.kind = scenario::SignalKind::kImpulse;
  strokes.repeat_s = 0.1;
  strokes.width_s = 1e-3;
  EXPECT_TRUE(FindSineSteps(Play(strokes, 0.5)).empty());
}

TEST(SineSteps, AreNoneWhenTheAmplitudeWasCutBack) {
  auto samples = Play(SteppedSine(), 25 * 0.4);
  for (std::size_t n = 9000; n < samples.size(); ++n) samples[n] *= 0.5;
  EXPECT_TRUE(FindSineSteps(samples).empty());
}

TEST(SineSteps, HalfAPeriodIsNoSine) {
  std::vector<double> samples(500);
  for (std::size_t n = 0; n < samples.size(); ++n) {
    samples[n] = std::sin(std::numbers::pi * (static_cast<double>(n) + 0.5) / 500.0);
  }
  EXPECT_TRUE(FindSineSteps(samples).empty());
  EXPECT_TRUE(FindSineSteps({}).empty());
}

TEST(SineSteps, AmplitudeHasThePhaseOfItsFirstSample) {
  std::vector<double> samples(1000);
  for (std::size_t n = 0; n < samples.size(); ++n) {
    samples[n] = 3.0 + 2.0 * std::cos(0.05 * static_cast<double>(n + 40) + 0.7);
  }
  const auto c = SineAmplitude(samples, 0.05 / (2.0 * std::numbers::pi), 40);
  EXPECT_NEAR(std::abs(c), 2.0, 1e-9);  // exact but for rounding
  EXPECT_NEAR(std::arg(c), 0.7, 1e-9);
}

}  // namespace
}  // namespace levitas::identification

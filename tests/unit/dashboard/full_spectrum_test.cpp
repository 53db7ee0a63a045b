#include "dashboard/full_spectrum.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "batches.hpp"

namespace levitas::dashboard {
namespace {

constexpr double kRateHz = 10'000.0;
constexpr double kLineHz = kRateHz / kSpectrumLength;

/// Samples of a circular orbit of `radius` at a signed frequency, on a line of the spectrum.
SampleStore Circle(double radius_m, double frequency_hz, int cycles = 4200) {
  SampleStore store(SmallRig());
  EXPECT_TRUE(store.Add(Batch(100, cycles, [&](std::int64_t cycle, int axis) {
    const double angle =
        2.0 * std::numbers::pi * frequency_hz * static_cast<double>(cycle) / kRateHz;
    // An offset, too: it is no vibration and must not be seen as one.
    return 20e-6 + radius_m * (axis == 0 ? std::cos(angle) : std::sin(angle));
  })));
  return store;
}

double FrequencyOf(const FullSpectrum& spectrum, std::size_t line) {
  return -spectrum.highest_hz + static_cast<double>(line) * spectrum.line_spacing_hz;
}

TEST(FullSpectrum, ShowsAForwardCircleWithItsRadiusAtItsFrequency) {
  const double frequency_hz = 20.0 * kLineHz;
  const auto spectrum = SpectrumOf(Circle(5e-6, frequency_hz), 400.0);
  ASSERT_TRUE(spectrum);
  const auto& lines = spectrum->amplitude_m.at(0);
  const auto peak =
      static_cast<std::size_t>(std::max_element(lines.begin(), lines.end()) - lines.begin());
  EXPECT_NEAR(FrequencyOf(*spectrum, peak), frequency_hz, 1e-6);  // rounding of the sum
  // The samples travel as 32-bit numbers: 6e-8 of 25 um.
  EXPECT_NEAR(lines[peak], 5e-6, 1e-11);
  EXPECT_LT(lines[lines.size() - 1 - peak], 1e-10) << "nothing runs backward";
}

TEST(FullSpectrum, ShowsABackwardCircleOnTheOtherSide) {
  const auto spectrum = SpectrumOf(Circle(5e-6, -20.0 * kLineHz), 400.0);
  ASSERT_TRUE(spectrum);
  const auto& lines = spectrum->amplitude_m.at(0);
  const auto peak =
      static_cast<std::size_t>(std::max_element(lines.begin(), lines.end()) - lines.begin());
  EXPECT_LT(FrequencyOf(*spectrum, peak), 0.0);
}

TEST(FullSpectrum, HasItsLinesSymmetricAboutZeroUpToTheHighest) {
  const auto spectrum = SpectrumOf(Circle(5e-6, 100.0), 400.0);
  ASSERT_TRUE(spectrum);
  EXPECT_LE(spectrum->highest_hz, 400.0);
  EXPECT_GT(spectrum->highest_hz, 400.0 - kLineHz);
  const auto lines = spectrum->amplitude_m.at(0).size();
  EXPECT_EQ(lines % 2, 1U);
  EXPECT_NEAR(FrequencyOf(*spectrum, lines / 2), 0.0, 1e-9);  // rounding
}

TEST(FullSpectrum, KeepsAPeakAndItsSideHoweverWideItReaches) {
  for (const double frequency_hz : {700.0 * kLineHz, -701.0 * kLineHz, 3.0 * kLineHz}) {
    const auto spectrum = SpectrumOf(Circle(5e-6, frequency_hz), 5000.0);
    ASSERT_TRUE(spectrum);
    const auto& lines = spectrum->amplitude_m.at(0);
    EXPECT_LE(lines.size(), 2 * kMostLines + 1);
    EXPECT_GT(spectrum->highest_hz, 4900.0);
    const auto peak =
        static_cast<std::size_t>(std::max_element(lines.begin(), lines.end()) - lines.begin());
    EXPECT_NEAR(FrequencyOf(*spectrum, peak), frequency_hz, 0.51 * spectrum->line_spacing_hz);
    EXPECT_NEAR(lines[peak], 5e-6, 1e-11);  // as in one that is not thinned
    EXPECT_NEAR(FrequencyOf(*spectrum, lines.size() / 2), 0.0, 1e-9);
  }
}

TEST(FullSpectrum, IsNotMadeOfSamplesWithAGap) {
  SampleStore store = Circle(5e-6, 100.0);
  ASSERT_TRUE(SpectrumOf(store, 400.0));
  ASSERT_TRUE(store.Add(Batch(90'000, 128, [](std::int64_t, int) { return 0.0; })));
  EXPECT_FALSE(SpectrumOf(store, 400.0));
}

TEST(FullSpectrum, IsNotMadeOfReadingsThatAreNoNumbers) {
  SampleStore store = Circle(5e-6, 100.0);
  ASSERT_TRUE(store.Add(
      Batch(4300, 1, [](std::int64_t, int) { return std::numeric_limits<double>::quiet_NaN(); })));
  EXPECT_FALSE(SpectrumOf(store, 400.0));
}

}  // namespace
}  // namespace levitas::dashboard

#include "analysis/records/spectrum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "common/random.hpp"

namespace levitas::analysis {
namespace {

constexpr double kRateHz = 10'000.0;

std::vector<double> Noise(std::size_t count, double rms, std::uint64_t seed) {
  Random random(seed);
  std::vector<double> values(count);
  for (double& value : values) value = rms * random.Normal();
  return values;
}

TEST(Welch, SpreadsWhiteNoiseEvenlyOverAllFrequencies) {
  Welch welch(1024, kRateHz);
  welch.Add(Noise(200'000, 2.0, 20261121));
  const auto density = welch.Density();
  const double expected = 4.0 / (kRateHz / 2.0);
  const auto averages = static_cast<double>(welch.averages());
  // A line scatters by 1/sqrt(averages) (a little more for half overlap): six times that.
  for (std::size_t line = 2; line + 2 < density.size(); ++line) {
    EXPECT_NEAR(density[line], expected, 6.0 * 1.06 * expected / std::sqrt(averages)) << line;
  }
}

TEST(Welch, KeepsThePowerOfTheSignal) {
  const auto values = Noise(200'000, 3.0, 7);
  double power = 0.0;
  for (const double value : values) power += value * value;
  power /= static_cast<double>(values.size());
  Welch welch(512, kRateHz);
  welch.Add(values);
  double sum = 0.0;
  for (const double density : welch.Density()) sum += density * welch.line_spacing_hz();
  EXPECT_NEAR(sum, power, 0.01 * power);  // the window weighs the ends of the record less
}

TEST(Welch, PutsASineOnItsLineWithItsPower) {
  Welch welch(1000 + 24, kRateHz);
  const double frequency_hz = 51.0 * welch.line_spacing_hz();
  std::vector<double> values(10'240);
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] =
        5.0 * std::sin(2.0 * std::numbers::pi * frequency_hz * static_cast<double>(i) / kRateHz);
  }
  welch.Add(values);
  const auto density = welch.Density();
  double near = 0.0;
  for (std::size_t line = 49; line <= 53; ++line) near += density[line];
  EXPECT_NEAR(near * welch.line_spacing_hz(), 12.5, 1e-9);  // 5^2/2, all within the Hann lobe
  EXPECT_LT(density[100], 1e-12 * density[51]);
}

TEST(Welch, IgnoresPiecesShorterThanASegment) {
  Welch welch(64, kRateHz);
  welch.Add(Noise(63, 1.0, 1));
  EXPECT_EQ(welch.averages(), 0U);
  for (const double density : welch.Density()) EXPECT_EQ(density, 0.0);
  welch.Add(Noise(96, 1.0, 1));
  EXPECT_EQ(welch.averages(), 2U);
}

TEST(Coherence, IsOneForAFilteredCopyAndChanceForUnrelatedSignals) {
  const auto one = Noise(100'000, 1.0, 1);
  const auto other = Noise(100'000, 1.0, 2);
  std::vector<double> copy(one.size(), 0.0);
  for (std::size_t i = 1; i < one.size(); ++i) copy[i] = 3.0 * one[i] - 1.0 * one[i - 1];
  Coherence same(256);
  same.Add(one, copy);
  // A two-tap filter is shorter than a segment by a factor of 128: 1 % escapes at its edges.
  for (const double value : same.Squared()) EXPECT_GT(value, 0.99);
  Coherence unrelated(256);
  unrelated.Add(one, other);
  double mean = 0.0;
  for (const double value : unrelated.Squared()) mean += value / 129.0;
  // 129 lines, each scattered by its own mean: 0.12 of it; four times that.
  EXPECT_NEAR(mean, unrelated.Chance(), 0.5 * unrelated.Chance());
}

TEST(Coherence, RefusesSignalsOfDifferentLengths) {
  Coherence coherence(64);
  EXPECT_THROW(coherence.Add(Noise(100, 1.0, 1), Noise(99, 1.0, 2)), std::invalid_argument);
  EXPECT_EQ(coherence.Chance(), 1.0);
}

TEST(Welch, RefusesSegmentsItCannotTransform) {
  EXPECT_THROW(Welch(100, kRateHz), std::invalid_argument);
  EXPECT_THROW(Welch(4, kRateHz), std::invalid_argument);
  EXPECT_THROW(Welch(0, kRateHz), std::invalid_argument);
}

}  // namespace
}  // namespace levitas::analysis

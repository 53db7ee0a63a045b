#include "identification/frf/smoothed_sensitivity.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "common/random.hpp"

namespace levitas::identification {
namespace {

constexpr double kTop = 2.5;
constexpr double kTopHz = 250.0;

/// |S| = 1 far from a resonance at 250 Hz that makes it 2.5, with noise of `sigma` on each line.
FrequencyResponse Noisy(double damping, double sigma, std::uint64_t seed) {
  Random random(seed);
  FrequencyResponse r;
  r.channels = {"x"};
  for (double f = 1.25; f <= 500.0; f += 1.25) {
    const std::complex<double> s{0.0, f / kTopHz};
    const std::complex<double> wide = 2.0 * damping * s;
    const std::complex<double> noise(random.Normal(), random.Normal());
    r.frequency_hz.push_back(f);
    r.sensitivity.emplace_back(Eigen::MatrixXcd::Constant(
        1, 1, (s * s + kTop * wide + 1.0) / (s * s + wide + 1.0) + sigma * std::sqrt(0.5) * noise));
    r.own_variance.emplace_back(Eigen::VectorXd::Constant(1, sigma * sigma));
  }
  return r;
}

double LargestLine(const FrequencyResponse& r) {
  double largest = 0.0;
  for (const auto& s : r.sensitivity) largest = std::max(largest, std::abs(s(0, 0)));
  return largest;
}

double LargestSmoothed(const FrequencyResponse& r) {
  return std::ranges::max(SmoothedSensitivity(r, 0), {}, &SmoothedLine::size).size;
}

TEST(SmoothedSensitivity, TakesAwayWhatNoiseAddsToTheLargestLine) {
  double single = 0.0;
  double smoothed = 0.0;
  constexpr int kRecords = 40;
  for (int n = 0; n < kRecords; ++n) {
    const FrequencyResponse r = Noisy(0.1, 0.25, 100U + static_cast<std::uint64_t>(n));
    single += LargestLine(r) / kTop / kRecords;
    smoothed += LargestSmoothed(r) / kTop / kRecords;
  }
  // The largest of 40 lines near the top with a sigma of 10 %: some 1.1; 3 % is half a sigma of
  // the fitted value.
  EXPECT_GT(single, 1.05);
  EXPECT_NEAR(smoothed, 1.0, 0.03);
}

TEST(SmoothedSensitivity, KeepsTheLineOfAPeakNarrowerThanItsNeighbours) {
  // 0.2 % damping: 1 Hz wide, lines 1.25 Hz apart; one stands on the top.
  const FrequencyResponse r = Noisy(0.002, 0.02, 3);
  const auto lines = SmoothedSensitivity(r, 0);
  const auto top = std::ranges::max_element(lines, {}, &SmoothedLine::size) - lines.begin();
  EXPECT_NEAR(r.frequency_hz[static_cast<std::size_t>(top)], kTopHz, 1.3);
  EXPECT_EQ(lines[static_cast<std::size_t>(top)].lines, 1U);
  EXPECT_GT(lines[100].lines, 10U);  // at 126 Hz, where |S| is flat
}

TEST(SmoothedSensitivity, LeavesLinesWithoutNoiseAsTheyAre) {
  const FrequencyResponse r = Noisy(0.1, 0.0, 1);
  EXPECT_EQ(LargestSmoothed(r), LargestLine(r));
}

TEST(SmoothedSensitivity, HasTheSigmaOfAParabolaThroughItsLines) {
  const FrequencyResponse r = Noisy(0.1, 0.25, 5);
  for (const SmoothedLine& line : SmoothedSensitivity(r, 0)) {
    const auto n = static_cast<double>(line.lines);
    if (line.lines == 1) continue;
    // Centre of a parabola through n equally spaced points: 3 (3 n^2 - 7) / (4 n (n^2 - 4)).
    const double share = 3.0 * (3.0 * n * n - 7.0) / (4.0 * n * (n * n - 4.0));
    EXPECT_NEAR(line.sigma, 0.25 * std::sqrt(share), 1e-9);
  }
}

}  // namespace
}  // namespace levitas::identification

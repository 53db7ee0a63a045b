// The whitening recursion against the equations that it solves, and against a process whose
// correlation is a closed form.

#include "diagnosis/model/levinson.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "common/random.hpp"

namespace levitas::diagnosis {
namespace {

/// Correlation of white noise of unit variance passed through a random filter of eight taps.
std::vector<double> RandomCorrelation(std::uint64_t seed, std::size_t order) {
  Random random(seed);
  std::vector<double> taps(8);
  for (double& tap : taps) tap = random.Normal();
  std::vector<double> correlation(order + 1, 0.0);
  for (std::size_t k = 0; k <= order; ++k) {
    for (std::size_t i = 0; i + k < taps.size(); ++i) correlation[k] += taps[i] * taps[i + k];
  }
  return correlation;
}

TEST(WhiteningFilter, SolvesTheYuleWalkerEquations) {
  constexpr std::size_t kOrder = 6;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const std::vector<double> r = RandomCorrelation(seed, kOrder);
    const std::vector<double> filter = WhiteningFilter(r, 1.0);
    ASSERT_EQ(filter.size(), kOrder + 1);
    // Toeplitz: sum_k filter_k r_|i-k| is zero for every lag of the past, and the power that is
    // left, times the filter's scale, for none.
    for (std::size_t i = 0; i <= kOrder; ++i) {
      double sum = 0.0;
      for (std::size_t k = 0; k <= kOrder; ++k) {
        sum += filter[k] * r[i > k ? i - k : k - i];
      }
      // Rounding of seven steps, each of a condition of up to 1e4.
      EXPECT_NEAR(sum * filter[0], i == 0 ? 1.0 : 0.0, 1e-9) << "lag " << i << ", seed " << seed;
    }
  }
}

TEST(WhiteningFilter, OfASecondOrderProcessIsItsOwnEquationAndNothingBeyond) {
  // x[n] = a1 x[n-1] + a2 x[n-2] + e, unit variance of e: r0 and r1 from the stationary equations.
  constexpr double kA1 = 1.4;
  constexpr double kA2 = -0.7;
  const double ratio = kA1 / (1.0 - kA2);  // r1/r0
  const double r0 = 1.0 / (1.0 - kA1 * ratio - kA2 * (kA1 * ratio + kA2));
  std::vector<double> r{r0, ratio * r0};
  while (r.size() < 7) r.push_back(kA1 * r[r.size() - 1] + kA2 * r[r.size() - 2]);
  const std::vector<double> filter = WhiteningFilter(r, 1.0);
  EXPECT_NEAR(filter[0], 1.0, 1e-12);
  EXPECT_NEAR(filter[1], -kA1, 1e-12);
  EXPECT_NEAR(filter[2], -kA2, 1e-12);
  for (std::size_t k = 3; k < filter.size(); ++k) EXPECT_NEAR(filter[k], 0.0, 1e-12) << k;
}

TEST(WhiteningFilter, ASignalOfOtherUnitsOrLengthHasTheFilterDividedByItsScale) {
  std::vector<double> r = RandomCorrelation(5, 4);
  const std::vector<double> plain = WhiteningFilter(r, 1.0);
  for (double& value : r) value *= 1000.0 * 1e-12;  // a thousand samples, in micrometres
  const std::vector<double> scaled = WhiteningFilter(r, 1000.0);
  for (std::size_t k = 0; k < plain.size(); ++k) {
    EXPECT_NEAR(scaled[k] * 1e-6, plain[k], 1e-12 * plain[0]);
  }
}

TEST(WhiteningFilter, ASignalWithoutPowerIsLeftAsItIs) {
  EXPECT_EQ(WhiteningFilter({0.0, 0.0, 0.0}, 500.0), (std::vector<double>{1.0, 0.0, 0.0}));
  EXPECT_EQ(WhiteningFilter({0.0}, 0.0), std::vector<double>{1.0});
}

}  // namespace
}  // namespace levitas::diagnosis

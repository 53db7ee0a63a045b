#include "plant_sim/effect/eddy_current.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

namespace levitas::effect {
namespace {

/// The bank of lags at p = s tau.
std::complex<double> Bank(std::complex<double> p) {
  const EddyLags& eddy = Eddy();
  std::complex<double> sum = eddy.direct;
  for (std::size_t k = 0; k < kEddyLags; ++k) sum += eddy.gain[k] / (1.0 + p / eddy.rate[k]);
  return sum;
}

TEST(EddyLags, FollowTheHalfOrderLawOverTheBand) {
  // 1/(1 + sqrt(j w tau)), exactly. With spacing D of the rates in ln x the trapezoid rule leaves
  // 2 exp(-pi^2/D) of the integrand (pole at a distance of pi/2): 0.33 % here; the tail that is
  // lumped below the slowest rate adds (2/pi) sqrt(x_slow): 0.45 %.
  for (double exponent = -6.0; exponent <= 1.0; exponent += 0.05) {
    const std::complex<double> p(0.0, std::pow(10.0, exponent));
    const std::complex<double> exact = 1.0 / (1.0 + std::sqrt(p));
    EXPECT_LT(std::abs(Bank(p) / exact - 1.0), 0.008) << "w tau = 1e" << exponent;
  }
}

TEST(EddyLags, LoseTenDecibelsPerDecadeAndTendToFortyFiveDegrees) {
  // Slope and phase of 1/(1 + sqrt p) at p = j: |.| falls as |1 + sqrt j|, phase -atan(s/(1 + s)).
  const double s = std::sqrt(0.5);
  EXPECT_NEAR(std::arg(Bank({0.0, 1.0})), -std::atan(s / (1.0 + s)), 0.008);
  EXPECT_NEAR(std::arg(Bank({0.0, 10.0})), -0.604, 0.01);  // a first-order lag: -1.47
  EXPECT_GT(std::arg(Bank({0.0, 10.0})), -std::numbers::pi / 4.0);
}

TEST(EddyLags, AreStableWithPositiveGainsThatSumToOne) {
  const EddyLags& eddy = Eddy();
  double sum = eddy.direct;
  EXPECT_GT(eddy.direct, 0.0);
  for (std::size_t k = 0; k < kEddyLags; ++k) {
    EXPECT_GT(eddy.rate[k], 0.0);
    EXPECT_GT(eddy.gain[k], 0.0);
    if (k > 0) {
      EXPECT_GT(eddy.rate[k], eddy.rate[k - 1]);
    }
    sum += eddy.gain[k];
  }
  EXPECT_NEAR(sum, 1.0, 1e-15);  // rounding of eleven additions
}

TEST(EddyOutput, OfSettledLagsIsTheCurrentItself) {
  const std::array<double, kEddyLags> settled = [] {
    std::array<double, kEddyLags> state{};
    state.fill(0.37);
    return state;
  }();
  EXPECT_NEAR(EddyOutput(0.37, settled.data()), 0.37, 1e-15);
}

}  // namespace
}  // namespace levitas::effect

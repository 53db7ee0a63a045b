#include "design/synthesis/hinf_norm.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "common/problem.hpp"
#include "design/synthesis/hamiltonian.hpp"
#include "numerics/spectra/spectra.hpp"
#include "plants.hpp"

namespace levitas::synthesis {
namespace {

StateSpace Resonance(double w, double damping_ratio) {
  StateSpace out = Gain(Eigen::MatrixXd::Zero(1, 1));
  out.A = Eigen::Matrix2d{{0.0, 1.0}, {-w * w, -2.0 * damping_ratio * w}};
  out.B = Eigen::Vector2d(0.0, w * w);
  out.C = Eigen::RowVector2d(1.0, 0.0);
  return out;
}

TEST(HinfNorm, OfAResonanceIsItsPeak) {
  for (const double zeta : {0.5, 0.05, 1e-4}) {
    const double w = 4587.0;
    const HinfNorm norm = NormOf(Resonance(w, zeta));
    const double peak = 1.0 / (2.0 * zeta * std::sqrt(1.0 - zeta * zeta));
    EXPECT_LE(norm.lower, peak * (1.0 + 1e-9)) << zeta;
    EXPECT_GE(norm.upper, peak * (1.0 - 1e-9)) << zeta;
    EXPECT_LT(norm.upper, peak * (1.0 + 2e-4)) << zeta;  // the tolerance asked for, twice
    EXPECT_NEAR(norm.rad_per_s, w * std::sqrt(1.0 - 2.0 * zeta * zeta), 0.02 * w);
  }
}

TEST(HinfNorm, OfALowPassIsItsGainAtZeroAndOfAHighPassItsDirectGain) {
  const HinfNorm low = NormOf(FirstOrder(3.0, 1e4, 2.0));
  EXPECT_NEAR(low.upper, 3.0, 1e-3);
  EXPECT_EQ(low.rad_per_s, 0.0);
  const HinfNorm high = NormOf(FirstOrder(1.0, 2.0, 10.0));
  EXPECT_NEAR(high.upper, 5.0, 1e-3);
  EXPECT_TRUE(std::isinf(high.rad_per_s));
}

TEST(HinfNorm, OfAnAllPassIsOneAtEveryFrequency) {
  const HinfNorm norm = NormOf(FirstOrder(1.0, -3.0, 3.0));
  EXPECT_LE(norm.lower, 1.0 + 1e-9);
  EXPECT_NEAR(norm.upper, 1.0, 2e-4);
}

TEST(HinfNorm, BoundsADenseGridOfDrawnModels) {
  Random random(20261126);
  for (int trial = 0; trial < 30; ++trial) {
    const StateSpace system = DrawStable(random, 8, 3, 2);
    const HinfNorm norm = NormOf(system);
    double largest = 0.0;
    for (int i = 0; i <= 4000; ++i) {
      const double w = i == 0 ? 0.0 : std::pow(10.0, -3.0 + 6.0 * i / 4000.0);
      const Eigen::JacobiSVD<Eigen::MatrixXcd> svd(Response(system, w));
      largest = std::max(largest, svd.singularValues()(0));
    }
    EXPECT_LE(largest, norm.upper) << "trial " << trial;
    EXPECT_GE(largest, 0.99 * norm.lower) << "trial " << trial;  // the grid's own step
  }
}

TEST(HinfNorm, OfAnUnstableModelIsRefused) {
  EXPECT_THROW(static_cast<void>(NormOf(FirstOrder(1.0, 5.0, -2.0))), Problem);
}

TEST(CrossingFrequencies, AreWhereALowPassHasTheGainAskedFor) {
  // |3/(1 + jw/2)| = 1.5 at w = 2 sqrt(3)
  Eigen::MatrixXd pi = Eigen::Vector2d(1.0, -1.5 * 1.5).asDiagonal();
  StateSpace low = FirstOrder(3.0, 2e9, 2.0);
  const auto real = CrossingFrequencies(low, pi);
  ASSERT_TRUE(real);
  ASSERT_EQ(real->size(), 1U);
  EXPECT_NEAR(real->front(), 2.0 * std::sqrt(3.0), 1e-6);
  const auto both = CrossingFrequencies(low, Eigen::MatrixXcd(pi.cast<std::complex<double>>()));
  ASSERT_TRUE(both);
  ASSERT_EQ(both->size(), 2U);
  EXPECT_NEAR(both->front(), -2.0 * std::sqrt(3.0), 1e-6);
}

}  // namespace
}  // namespace levitas::synthesis

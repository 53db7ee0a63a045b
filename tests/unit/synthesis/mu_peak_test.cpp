#include "design/synthesis/mu_peak.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "common/problem.hpp"
#include "design/synthesis/hinf_norm.hpp"
#include "plants.hpp"

namespace levitas::synthesis {
namespace {

const UncertaintyBlocks kMixed{{BlockKind::kRepeatedReal, 2, 2},
                               {BlockKind::kFullComplex, 1, 1},
                               {BlockKind::kFullComplex, 1, 1}};

TEST(MuPeak, OfOneFullBlockIsTheHinfNorm) {
  Random random(11);
  const StateSpace system = DrawStable(random, 6, 3, 2);
  const MuPeak peak = PeakOfMu(system, {{BlockKind::kFullComplex, 2, 3}}, {.tolerance = 1e-3});
  const HinfNorm norm = NormOf(system);
  EXPECT_GE(peak.upper, norm.lower);
  EXPECT_LE(peak.upper, norm.upper * 1.002);  // the tolerance, twice
  EXPECT_NEAR(peak.lower, norm.lower, 2e-3 * norm.lower);
}

TEST(MuPeak, FindsAResonanceBetweenTheGridPoints) {
  // Damping ratio 1e-4 between two points of a grid of five.
  StateSpace system = Gain(Eigen::MatrixXd::Zero(1, 1));
  const double w = 4587.0;
  system.A = Eigen::Matrix2d{{0.0, 1.0}, {-w * w, -2e-4 * w}};
  system.B = Eigen::Vector2d(0.0, w * w);
  system.C = Eigen::RowVector2d(1.0, 0.0);
  const StateSpace two = Append(system, Gain(Eigen::MatrixXd::Ones(1, 1)));
  const MuPeak peak = PeakOfMu(two, UncertaintyBlocks(2), {.points = 5});
  EXPECT_NEAR(peak.upper, 5000.0, 0.02 * 5000.0);  // 1/(2 zeta), and the tolerance
  EXPECT_NEAR(peak.rad_per_s, w, 1.0);
}

TEST(MuPeak, BoundsADenseGridOfDrawnModelsWithMixedBlocks) {
  Random random(12);
  for (int trial = 0; trial < 4; ++trial) {
    const StateSpace system = DrawStable(random, 6, 4, 4);
    const MuPeak peak = PeakOfMu(system, kMixed, {.points = 8});
    EXPECT_LE(peak.lower, peak.at_peak * (1.0 + 1e-9));
    double largest = 0.0;
    for (int i = 0; i <= 300; ++i) {
      const double at = std::pow(10.0, -2.0 + 4.0 * i / 300.0);
      largest = std::max(largest, MuUpperBound(Response(system, at), kMixed).value);
    }
    EXPECT_LE(largest, peak.upper) << trial;
    EXPECT_GE(largest, 0.97 * peak.at_peak) << trial;  // step of the grid
  }
}

TEST(MuPeak, OfAnUnstableModelIsRefused) {
  const StateSpace two = Append(FirstOrder(1.0, 5.0, -2.0), FirstOrder(1.0, 5.0, 2.0));
  EXPECT_THROW(static_cast<void>(PeakOfMu(two, UncertaintyBlocks(2))), Problem);
}

}  // namespace
}  // namespace levitas::synthesis

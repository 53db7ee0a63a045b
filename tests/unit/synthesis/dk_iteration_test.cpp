#include "design/synthesis/dk_iteration.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "design/synthesis/hinf_norm.hpp"
#include "design/synthesis/magnitude_fit.hpp"
#include "numerics/spectra/spectra.hpp"
#include "plants.hpp"

namespace levitas::synthesis {
namespace {

Eigen::VectorXd Logarithmic(double first, double last, Eigen::Index points) {
  return Eigen::VectorXd::LinSpaced(points, std::log(first), std::log(last)).array().exp();
}

TEST(MagnitudeFit, RecoversAMinimumPhaseModelFromItsGain) {
  const Eigen::VectorXd w = Logarithmic(0.01, 1e4, 120);
  const StateSpace given = Series(FirstOrder(2.0, 30.0, 3.0), FirstOrder(1.0, 5.0, 200.0));
  Eigen::VectorXd gain(w.size());
  for (Eigen::Index i = 0; i < w.size(); ++i) gain(i) = std::abs(Response(given, w(i))(0, 0));
  const MagnitudeFit fit = FitMagnitude(w, gain, Eigen::VectorXd::Ones(w.size()), 2);
  EXPECT_LT(fit.log_error, 0.01);  // the grid's segments bend the phase
  for (const double at : {0.3, 7.0, 60.0, 500.0})
    EXPECT_NEAR(std::abs(Response(fit.system, at)(0, 0) / Response(given, at)(0, 0)), 1.0, 0.01);
}

TEST(MagnitudeFit, IsStableWithAStableInverse) {
  Random random(41);
  const Eigen::VectorXd w = Logarithmic(0.1, 1e5, 60);
  for (int trial = 0; trial < 20; ++trial) {
    Eigen::VectorXd gain(w.size());
    double log_gain = 0.0;
    for (double& value : gain) value = std::exp(log_gain += 0.2 * random.Normal());
    for (int order = 0; order <= 5; ++order) {
      const MagnitudeFit fit = FitMagnitude(w, gain, Eigen::VectorXd::Ones(w.size()), order);
      EXPECT_EQ(fit.system.states(), order);
      EXPECT_TRUE(IsStable(fit.system));
      EXPECT_TRUE(IsStable(Inverse(fit.system)));
      const Eigen::MatrixXcd one = Response(Series(fit.system, Inverse(fit.system)), 3.0);
      EXPECT_LT(std::abs(one(0, 0) - 1.0), 1e-8);
    }
  }
}

TEST(MagnitudeFit, TakesNoStateForAConstant) {
  const Eigen::VectorXd w = Logarithmic(0.1, 1e3, 30);
  const MagnitudeFit fit =
      FitMagnitudeUpTo(w, Eigen::VectorXd::Constant(30, 7.0), Eigen::VectorXd::Ones(30), 5, 0.01);
  EXPECT_EQ(fit.system.states(), 0);
  EXPECT_NEAR(fit.system.D(0, 0), 7.0, 1e-12);
}

/// Spinning satellite of two axes whose channels are coupled: the textbook case in which singular
/// values mislead (Zhou, Doyle & Glover 1996, section 9.6), with input uncertainty per channel of
/// 20 % at low and 200 % at high frequency, and performance 1/2 of the sensitivity up to 0.1 rad/s.
GeneralisedPlant Satellite() {
  constexpr double kCoupling = 10.0;
  StateSpace body = Gain(Eigen::MatrixXd::Zero(2, 2));
  body.A = Eigen::Matrix2d{{0.0, kCoupling}, {-kCoupling, 0.0}};
  body.B = Eigen::Matrix2d::Identity();
  body.C = Eigen::Matrix2d{{1.0, kCoupling}, {-kCoupling, 1.0}};
  const StateSpace doubt = FirstOrder(0.2, 4.0, 40.0);
  const StateSpace goal = FirstOrder(5.0, 10.0, 0.1);
  const auto twice = [](const StateSpace& one) { return Append(one, one); };
  const Eigen::MatrixXd one = Eigen::Matrix2d::Identity();
  const Eigen::MatrixXd none = Eigen::Matrix2d::Zero();
  // Inputs: w_doubt, reference, u. u reaches the doubt's weight; the body sees u + w_doubt.
  Eigen::MatrixXd in(6, 6);
  in << none, none, one, one, none, one, none, one, none;  // u; body's input; reference
  StateSpace middle = Append(Append(twice(doubt), body), Gain(one));
  Eigen::MatrixXd error(6, 6);  // doubt; goal's input; y
  error << one, none, none, none, one, one, none, one, one;
  StateSpace out = Series(Series(Gain(in), middle), Gain(error));
  return {Series(out, Append(Append(Gain(one), twice(goal)), Gain(one))), 2, 2};
}

TEST(DkIteration, FallsBelowTheControllerOfTheHinfNormAndHoldsItsBound) {
  const GeneralisedPlant plant = Satellite();
  const UncertaintyBlocks blocks{{BlockKind::kFullComplex, 1, 1},
                                 {BlockKind::kFullComplex, 1, 1},
                                 {BlockKind::kFullComplex, 2, 2}};
  const DkResult result =
      IterateDk(plant, blocks, {.peak = {.first_rad_per_s = 1e-3, .last_rad_per_s = 1e4}});
  ASSERT_GE(result.turns.size(), 2U);
  EXPECT_LT(result.peak.upper, 0.98 * result.turns.front().mu);
  const StateSpace loop = LowerFeedback(plant.system, result.controller);
  EXPECT_TRUE(IsStable(loop));
  EXPECT_LE(result.peak.at_peak, NormOf(loop).upper * (1.0 + 1e-6));  // mu is never above the norm
  // A drawn perturbation within 1/mu does not upset the loop.
  Random random(42);
  for (int trial = 0; trial < 200; ++trial) {
    Eigen::MatrixXd delta = Eigen::MatrixXd::Zero(4, 4);
    delta(0, 0) = random.Uniform() < 0.5 ? -1.0 : 1.0;
    delta(1, 1) = 2.0 * random.Uniform() - 1.0;
    Eigen::MatrixXd full = DrawMatrix(random, 2, 2);
    delta.bottomRightCorner(2, 2) =
        full / Eigen::JacobiSVD<Eigen::MatrixXd>(full).singularValues()(0);
    delta *= 0.999 / result.peak.upper;
    EXPECT_TRUE(IsStable(LowerFeedback(loop, Gain(delta)))) << trial;
  }
}

}  // namespace
}  // namespace levitas::synthesis

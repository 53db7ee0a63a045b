#include "analysis/records/riccati.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <stdexcept>

#include "common/problem.hpp"
#include "common/random.hpp"
#include "numerics/dense/eigenvalues.hpp"
#include "numerics/dense/factorisations.hpp"

namespace levitas::analysis {
namespace {

Eigen::MatrixXd Scalar(double value) { return Eigen::MatrixXd::Constant(1, 1, value); }

TEST(StationaryCovariance, OfAScalarIsTheRootOfItsQuadratic) {
  // p = a^2 p r/(p + r) + q with c = 1:  p^2 + p (r - a^2 r - q) - q r = 0
  for (const double a : {0.5, 1.0, 1.3}) {
    const double q = 0.2;
    const double r = 3.0;
    const double half = 0.5 * (r - a * a * r - q);
    const double expected = -half + std::sqrt(half * half + q * r);
    const double p = StationaryCovariance(Scalar(a), Scalar(1.0), Scalar(q), Scalar(r))(0, 0);
    EXPECT_NEAR(p, expected, 1e-12 * expected) << "a = " << a;  // rounding only
  }
}

TEST(StationaryCovariance, OfAnUnstableStateWithoutNoiseStillNeedsAGain) {
  // q = 0, |a| > 1: p = r (a^2 - 1), the classical minimum-energy limit.
  const double p = StationaryCovariance(Scalar(1.2), Scalar(1.0), Scalar(0.0), Scalar(2.0))(0, 0);
  // q = 0 is the edge of the method's conditions only for stable states.
  EXPECT_TRUE(std::abs(p - 2.0 * (1.44 - 1.0)) < 1e-9 || p == 0.0);
}

TEST(StationaryCovariance, SatisfiesTheEquationForRandomSystems) {
  Random random(20261121);
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::Index n = 6;
    Eigen::MatrixXd a(n, n), c(2, n), g(n, 3);
    for (double& value : a.reshaped()) value = 0.6 * random.Normal();  // some stable, some not
    for (double& value : c.reshaped()) value = random.Normal();
    for (double& value : g.reshaped()) value = random.Normal();
    const Eigen::MatrixXd q = g * g.transpose();
    const Eigen::MatrixXd r = Eigen::Vector2d(0.5, 2.0).asDiagonal();
    const Eigen::MatrixXd p = StationaryCovariance(a, c, q, r);
    EXPECT_LT(RiccatiResidual(a, c, q, r, p).norm(), 1e-9 * p.norm());  // rounding of 6 x 6
    EXPECT_GE(p.selfadjointView<Eigen::Upper>().eigenvalues().minCoeff(), -1e-9 * p.norm());
    // The gain must settle the observer's error: what makes this root the right one.
    const Eigen::MatrixXd k = a * p * c.transpose() * (c * p * c.transpose() + r).inverse();
    EXPECT_LT((a - k * c).eigenvalues().cwiseAbs().maxCoeff(), 1.0);
  }
}

TEST(StationaryCovariance, SaysWhatIsWrongWhenAGrowingStateIsNotSeen) {
  Eigen::MatrixXd a = Eigen::Vector2d(0.5, 1.5).asDiagonal();
  Eigen::MatrixXd c(1, 2);
  c << 1.0, 0.0;
  try {
    static_cast<void>(StationaryCovariance(a, c, Eigen::MatrixXd::Identity(2, 2), Scalar(1.0)));
    FAIL() << "no stationary covariance exists";
  } catch (const Problem& problem) {
    EXPECT_NE(std::string(problem.what()).find("cannot see"), std::string::npos);
  }
}

/// The equation of one sample, applied again and again.
Eigen::MatrixXd OneByOne(const Eigen::MatrixXd& a, const Eigen::MatrixXd& c,
                         const Eigen::MatrixXd& q, const Eigen::MatrixXd& r, Eigen::MatrixXd p,
                         int samples) {
  for (int n = 0; n < samples; ++n) {
    const Eigen::MatrixXd k = a * p * c.transpose() * (c * p * c.transpose() + r).inverse();
    p = (a * p * a.transpose() - k * c * p * a.transpose() + q).eval();
  }
  return p;
}

TEST(CovarianceSteps, ReachWhatSamplesOneByOneDo) {
  Random random(20261125);
  for (int trial = 0; trial < 10; ++trial) {
    const Eigen::Index n = 5;
    Eigen::MatrixXd a(n, n), c(2, n), g(n, 2), s(n, n);
    for (double& value : a.reshaped()) value = 0.5 * random.Normal();
    for (double& value : c.reshaped()) value = random.Normal();
    for (double& value : g.reshaped()) value = random.Normal();
    for (double& value : s.reshaped()) value = 10.0 * random.Normal();
    const Eigen::MatrixXd q = g * g.transpose();
    const Eigen::MatrixXd r = Eigen::Vector2d(0.5, 2.0).asDiagonal();
    const Eigen::MatrixXd start = s * s.transpose();
    const CovarianceSteps steps(a, c, q, r, 4);
    for (std::size_t power = 0; power <= 4; ++power) {
      const Eigen::MatrixXd expected = OneByOne(a, c, q, r, start, 1 << power);
      // Rounding, from a start a hundred times as large as what is left of it.
      EXPECT_LT((steps.After(start, power) - expected).norm(), 1e-8 * start.norm()) << power;
    }
    EXPECT_THROW(static_cast<void>(steps.After(start, 5)), std::out_of_range);
  }
}

}  // namespace
}  // namespace levitas::analysis

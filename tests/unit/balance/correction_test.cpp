// Corrections, what they leave, and influence coefficients put right, against matrices made by
// hand.
#include "identification/balance/correction.hpp"

#include <gtest/gtest.h>

#include "common/random.hpp"
#include "identification/balance/influence.hpp"

namespace levitas::balancing {
namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;

MatrixXcd Drawn(Random& draw, Eigen::Index rows, Eigen::Index columns) {
  MatrixXcd made(rows, columns);
  for (auto& entry : made.reshaped()) entry = {draw.Normal(), draw.Normal()};
  return made;
}

/// Responses of four axes to three planes, standing where `unbalance` puts the shaft.
std::vector<SpeedResponse> Responses(const VectorXcd& unbalance, std::uint64_t seed = 3) {
  Random draw(seed);
  std::vector<SpeedResponse> made;
  for (int i = 1; i <= 20; ++i) {
    const MatrixXcd per = Drawn(draw, 4, 3);
    made.push_back({30.0 * i, per, MatrixXcd::Identity(4, 4), per * unbalance});
  }
  return made;
}

TEST(Correction, OfAllPlanesIsTheUnbalanceTurnedRound) {
  const VectorXcd unbalance = VectorXcd::Random(3);
  const Correction made = Correct(Responses(unbalance), {0, 1, 2}, MatrixXd::Identity(6, 6));
  // The share that keeps idle planes still: 1e-6 of the diagonal.
  EXPECT_LT((made.added_kg_m + unbalance).norm(), 1e-5);
  EXPECT_LT((made.covariance - MatrixXd::Identity(6, 6)).norm(), 1e-4);
}

TEST(Correction, OfOnePlaneLeavesWhatThatPlaneCannotReach) {
  const VectorXcd unbalance = VectorXcd::Random(3);
  const auto responses = Responses(unbalance);
  const Correction made = Correct(responses, {1}, MatrixXd::Identity(6, 6));
  // Normal equations: what is left is orthogonal to what the plane can do.
  Complex pull = 0.0;
  double scale = 0.0;
  for (const SpeedResponse& at : responses) {
    const VectorXcd column = at.per_unbalance.col(1);
    pull += column.dot(at.now_m + column * made.added_kg_m[0]);
    scale += column.squaredNorm();
  }
  EXPECT_LT(std::abs(pull), 1e-5 * scale);
}

TEST(Correction, APlaneThatMovesNothingGetsNoWeight) {
  const VectorXcd unbalance = VectorXcd::Random(3);
  auto responses = Responses(unbalance);
  for (SpeedResponse& at : responses) at.per_unbalance.col(2) *= 1e-9;
  const Correction made = Correct(responses, {0, 1}, MatrixXd::Identity(6, 6));
  EXPECT_EQ(made.added_kg_m.size(), 2);
  EXPECT_TRUE(made.added_kg_m.allFinite());
}

TEST(Correction, ForecastIsTheOrbitThatTheWeightsLeave) {
  const VectorXcd unbalance = VectorXcd::Random(3);
  const auto responses = Responses(unbalance);
  const auto orbits = ForecastOrbits(responses, -unbalance, MatrixXd::Zero(6, 6));
  ASSERT_EQ(orbits.size(), responses.size());
  for (const OrbitForecast& at : orbits) {
    EXPECT_GT(at.before_m.minCoeff(), 0.0);
    EXPECT_LT(at.after_m.maxCoeff(), 1e-12);
    EXPECT_LT(at.after_high_m.maxCoeff(), 1e-12);
  }
}

TEST(Radii, OfACircleAnEllipseAndALine) {
  const Complex j(0.0, 1.0);
  VectorXcd circle(2);
  circle << 3.0, -3.0 * j;  // x = 3 cos, y = 3 sin
  EXPECT_NEAR(Radii(circle)[0], 3.0, 1e-12);
  VectorXcd ellipse(2);
  ellipse << 5.0, -2.0 * j;
  EXPECT_NEAR(Radii(ellipse)[0], 5.0, 1e-12);
  VectorXcd line(2);
  line << 3.0, 4.0;
  EXPECT_NEAR(Radii(line)[0], 5.0, 1e-12);
}

TEST(Influence, UpdatedCoefficientsExplainTheChangeThatWasMeasured) {
  const VectorXcd unbalance = VectorXcd::Random(3);
  const auto truth = Responses(unbalance, 5);
  auto model = truth;
  for (SpeedResponse& at : model) at.per_unbalance *= Complex(0.9, 0.1);
  const VectorXcd added = VectorXcd::Random(3);
  std::vector<analysis::TrackedWindow> before, now;
  for (const SpeedResponse& at : truth) {
    analysis::TrackedWindow window;
    window.speed_rad_per_s = at.speed_rad_per_s;
    window.position_m = at.per_unbalance * unbalance;
    before.push_back(window);
    window.position_m = at.per_unbalance * (unbalance + added);
    now.push_back(window);
  }
  const auto changes = UpdateInfluence(MeasuredResponse(before), MeasuredResponse(now), added,
                                       VectorXcd::Zero(4), model);
  ASSERT_EQ(changes.size(), model.size());
  for (std::size_t i = 0; i < model.size(); ++i) {
    EXPECT_LT((model[i].per_unbalance * added - truth[i].per_unbalance * added).norm(), 1e-12);
    EXPECT_LT((model[i].now_m - now[i].position_m).norm(), 1e-12);
    // Directions that were not tried stay the model's.
    EXPECT_LT((changes[i].measured_m - truth[i].per_unbalance * added).norm(), 1e-12);
  }
}

TEST(Influence, SpeedsThatARunDoesNotPassStayTheModels) {
  auto model = Responses(VectorXcd::Random(3));
  const auto as_it_was = model;
  std::vector<analysis::TrackedWindow> few(2);
  for (auto& window : few) window.position_m = VectorXcd::Zero(4);
  few[0].speed_rad_per_s = 100.0;
  few[1].speed_rad_per_s = 200.0;
  const auto changes = UpdateInfluence(MeasuredResponse(few), MeasuredResponse(few),
                                       VectorXcd::Ones(3), VectorXcd::Zero(4), model);
  EXPECT_EQ(changes.size(), 3U);  // 120, 150, 180
  EXPECT_EQ(model[0].per_unbalance, as_it_was[0].per_unbalance);
  EXPECT_NE(model[4].per_unbalance, as_it_was[4].per_unbalance);
}

}  // namespace
}  // namespace levitas::balancing

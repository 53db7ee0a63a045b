// Prediction so many steps ahead, between one step and the free run, on systems known in closed
// form.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "identification/nonlinear/hammerstein_wiener.hpp"
#include "identification/nonlinear/narx.hpp"

namespace levitas::identification {
namespace {

constexpr Eigen::Index kRows = 400;
constexpr double kPole = 0.9;
constexpr double kPlantGain = 0.5;

/// y_k = 0.9 y_{k-1} + 0.5 u_{k-1}, read with noise.
Series FirstOrder(double noise) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  Series series{1e-3, {"u"}, {"y"}, Eigen::MatrixXd(kRows, 1), Eigen::MatrixXd(kRows, 1)};
  double state = 0.0;
  for (Eigen::Index k = 0; k < kRows; ++k) {
    series.output(k, 0) = state + noise * normal(random);
    series.input(k, 0) = normal(random);
    state = kPole * state + kPlantGain * series.input(k, 0);
  }
  return series;
}

/// The model of that equation, with its true numbers.
LaggedModel TrueModel(const Series& series) {
  LaggedModel model = EmptyModel({1, 1, 1, 1, 1, 0}, series);
  model.features[0] = {{.factors = {model.layout.y(0, 1)}}, {.factors = {model.layout.u(0, 1)}}};
  model.theta[0] =
      Eigen::Vector2d(kPole, kPlantGain * model.input_scale[0] / model.output_scale[0]);
  return model;
}

/// To rounding: scales are taken out and put back in another order.
void ExpectAlike(const Eigen::MatrixXd& one, const Eigen::MatrixXd& other) {
  EXPECT_LT((one - other).cwiseAbs().maxCoeff(), 1e-12 * other.cwiseAbs().maxCoeff());
}

TEST(StepsAhead, OfOneStepAreThePredictionOfOneStep) {
  const Series series = FirstOrder(0.3);
  for (const Eigen::Index errors : {0, 2}) {
    const auto fit =
        FitNarx(series, {.layout = {1, 1, 2, 2, 1, errors}, .degree = 2, .most_terms = 6});
    ExpectAlike(PredictAhead(fit.model, series, 1, 0).output,
                PredictOneStep(fit.model, series).output);
  }
  const auto wiener = FitHammersteinWiener(series, {.order = 2, .noise_order = 1, .degree = 2});
  ExpectAlike(PredictAhead(wiener.model, series, 1, 0).output,
              PredictOneStep(wiener.model, series).output);
}

TEST(StepsAhead, OfAllRowsAreTheFreeRun) {
  const Series series = FirstOrder(0.3);
  const auto fit = FitNarx(series, {.layout = {1, 1, 2, 2, 1, 2}, .degree = 1, .most_terms = 5});
  ExpectAlike(PredictAhead(fit.model, series, kRows, 0).output,
              SimulateFreeRun(fit.model, series).output);
  ExpectAlike(PredictAhead(fit.model, series, 10 * kRows, 0).output,
              SimulateFreeRun(fit.model, series).output);
  // Its free run begins with measured rows when no feedback closes its loop; from rest with one.
  const auto wiener = FitHammersteinWiener(series, {.order = 2, .noise_order = 1, .degree = 1});
  const auto same = [&](Eigen::Index row, const Eigen::VectorXd&, Eigen::VectorXd& u) {
    u = series.input.row(row).transpose();
  };
  ExpectAlike(PredictAhead(wiener.model, series, kRows, 0).output,
              SimulateFreeRun(wiener.model, series, same).output);
}

// An error of a reading is carried on as pole^steps: of n steps ahead with the true model it is all
// that is left.
TEST(StepsAhead, ForgetTheErrorOfTheReadingTheyBeginWith) {
  const Series noisy = FirstOrder(0.3);
  const Series clean = FirstOrder(0.0);
  const LaggedModel model = TrueModel(noisy);
  for (const Eigen::Index steps : {1, 3, 20}) {
    const Eigen::MatrixXd ahead = PredictAhead(model, noisy, steps, 100).output;
    for (Eigen::Index k = 100; k < kRows; ++k) {
      const double begun_with = noisy.output(k - steps, 0) - clean.output(k - steps, 0);
      const double left = std::pow(kPole, static_cast<double>(steps)) * begun_with;
      EXPECT_NEAR(ahead(k, 0) - clean.output(k, 0), left, 1e-12) << steps << " " << k;
    }
    EXPECT_EQ(ahead.topRows(100), noisy.output.topRows(100));
  }
}

TEST(StepsAhead, SayWhereAModelThatGrowsLeavesAllBounds) {
  const Series series = FirstOrder(0.3);
  LaggedModel model = TrueModel(series);
  model.theta[0][0] = 2.0;
  EXPECT_FALSE(PredictAhead(model, series, 3, 0).diverged_at.has_value());
  const Prediction far = PredictAhead(model, series, 50, 0);
  ASSERT_TRUE(far.diverged_at.has_value());
  EXPECT_TRUE(far.output.allFinite());
}

}  // namespace
}  // namespace levitas::identification

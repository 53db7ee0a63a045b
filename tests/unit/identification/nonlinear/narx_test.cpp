// NARX and NARMAX on systems whose equation is known.
#include "identification/nonlinear/narx.hpp"

#include <gmock/gmock.h>

#include <Eigen/QR>
#include <map>
#include <string>

#include "identification/nonlinear/refine.hpp"
#include "numerics/factors/factors.hpp"
#include "tests/unit/identification/nonlinear/synthetic_series.hpp"

namespace levitas::identification {
namespace {

NarxOptions TwoLags() {
  NarxOptions options;
  options.layout.output_lags = 2;
  options.layout.input_lags = 2;
  options.most_terms = 5;
  return options;
}

std::map<std::string, double> Found(const LaggedModel& model) {
  std::map<std::string, double> found;
  for (std::size_t j = 0; j < model.features[0].size(); ++j) {
    const Feature& feature = model.features[0][j];
    double scale = model.output_scale[0];
    for (const Eigen::Index f : feature.factors) {
      const bool input = f >= model.layout.input_at() && f < model.layout.error_at();
      scale /= input ? model.input_scale[0] : model.output_scale[0];
    }
    found[FeatureName(model.layout, feature)] =
        scale * model.theta[0][static_cast<Eigen::Index>(j)];
  }
  return found;
}

TEST(Frols, ItsCoefficientsAreThoseOfLeastSquaresOnTheChosenColumns) {
  const Series s = test::WhiteInput(200, 6, 1, 11);
  const Eigen::VectorXd target = 2.0 * s.input.col(4) - s.input.col(1) + 0.1 * s.input.col(0);
  const FrolsResult r = SelectTerms(s.input, target, {.most_terms = 2});
  ASSERT_EQ(r.chosen, (std::vector<Eigen::Index>{4, 1}));
  Eigen::MatrixXd two(200, 2);
  two << s.input.col(4), s.input.col(1);
  // Two ways to the same normal equations: rounding only.
  EXPECT_LT((r.theta - two.colPivHouseholderQr().solve(target)).norm(), 1e-12);
  EXPECT_GT(r.ratio[0], r.ratio[1]);
  EXPECT_LT(r.ratio[0] + r.ratio[1], 1.0);
}

TEST(Frols, RatiosOfAllTermsOfAnExactModelAddUpToOne) {
  const Series s = test::WhiteInput(300, 3, 1, 12);
  const Eigen::VectorXd target = s.input * Eigen::Vector3d(1.0, -2.0, 0.5);
  const FrolsResult r = SelectTerms(s.input, target, {.most_terms = 3});
  EXPECT_NEAR(r.ratio[0] + r.ratio[1] + r.ratio[2], 1.0, 1e-12);  // rounding
}

TEST(Frols, AColumnThatRepeatsAChosenOneIsNotTaken) {
  Eigen::MatrixXd p = test::WhiteInput(100, 3, 1, 13).input;
  p.col(2) = 3.0 * p.col(0);
  const FrolsResult r = SelectTerms(p, p.col(0) + 0.3 * p.col(1), {.most_terms = 3});
  EXPECT_EQ(r.chosen.size(), 2U);
}

TEST(Narx, FindsTheTermsAndCoefficientsOfAKnownEquation) {
  const NarxFit fit = FitNarx(test::CubicSystem(3000, 0.0, 21), TwoLags());
  const auto found = Found(fit.model);
  ASSERT_EQ(found.size(), 5U);
  // Exact data: rounding, raised by the ridge of 1e-13.
  EXPECT_NEAR(found.at("y1(k-1)"), 1.5, 1e-7);
  EXPECT_NEAR(found.at("y1(k-2)"), -0.8, 1e-7);
  EXPECT_NEAR(found.at("u1(k-1)"), 0.1, 1e-7);
  EXPECT_NEAR(found.at("y1(k-1)^3"), -0.2, 1e-6);
  EXPECT_NEAR(found.at("u1(k-1) u1(k-2)"), 0.05, 1e-7);
}

TEST(Narx, FreeRunOfAnExactModelRepeatsDataItHasNotSeen) {
  const NarxFit fit = FitNarx(test::CubicSystem(3000, 0.0, 21), TwoLags());
  const Series fresh = test::CubicSystem(1000, 0.0, 22);
  EXPECT_GT(FitPercent(fresh.output, SimulateFreeRun(fit.model, fresh).output, 0)[0], 99.999);
}

TEST(Narx, OneStepFlattersAModelOfNoisyDataAndTheFreeRunDoesNot) {
  const Series noisy = test::CubicSystem(4000, 0.05, 23);
  const NarxFit fit = FitNarx(noisy, TwoLags());
  const Series clean = test::CubicSystem(4000, 0.0, 23);
  const double free = FitPercent(clean.output, SimulateFreeRun(fit.model, clean).output, 50)[0];
  // Lags of noisy outputs as regressors bias the coefficients (errors in variables).
  EXPECT_LT(free, 90.0);
  EXPECT_GT(free, 0.0);
}

TEST(Narx, RefiningTheFreeRunRemovesTheBiasOfNoise) {
  const Series noisy = test::CubicSystem(4000, 0.05, 23);
  const NarxFit fit = FitNarx(test::CubicSystem(3000, 0.0, 21), TwoLags());
  LaggedModel biased = fit.model;
  biased.theta[0] *= 0.97;
  const Refinement r = RefineFreeRun(biased, noisy);
  EXPECT_TRUE(r.converged);
  const auto found = Found(r.model);
  // Standard deviations of the estimate are below 0.002 here; four of them.
  EXPECT_NEAR(found.at("y1(k-1)"), 1.5, 0.008);
  EXPECT_NEAR(found.at("y1(k-2)"), -0.8, 0.008);
  EXPECT_NEAR(found.at("u1(k-1)"), 0.1, 0.008);
}

TEST(Narx, ADivergingFreeRunSaysWhere) {
  const Series s = test::CubicSystem(500, 0.0, 24);
  NarxFit fit = FitNarx(s, TwoLags());
  fit.model.theta[0] *= 2.0;
  const Prediction run = SimulateFreeRun(fit.model, s);
  ASSERT_TRUE(run.diverged_at.has_value());
  EXPECT_GT(*run.diverged_at, 2);
  EXPECT_TRUE(run.output.allFinite());
}

TEST(Narx, ANetworkApproximatesACurveThatIsNoPolynomial) {
  Series s = test::WhiteInput(4000, 1, 1, 25);
  for (Eigen::Index k = 1; k < s.rows(); ++k) {
    s.output(k, 0) = 0.7 * s.output(k - 1, 0) + std::tanh(3.0 * s.input(k - 1, 0));
  }
  NarxOptions options;
  options.layout.output_lags = 1;
  options.layout.input_lags = 1;
  const auto free_run = [&](std::size_t units) {
    options.network_units = units;
    options.degree = 1;
    options.most_terms = 3;
    const NarxFit fit = FitNarx(s, options);
    return FitPercent(s.output, SimulateFreeRun(fit.model, s).output, 5)[0];
  };
  EXPECT_LT(free_run(0), 90.0);  // the best line leaves a tenth of a curve that saturates
  EXPECT_GT(free_run(12), 97.0);
}

TEST(Narmax, ErrorTermsTakeTheColourOutOfTheNoise) {
  // y_k = 0.9 y_{k-1} + u_{k-1} + e_k + 0.8 e_{k-1}: without error terms the pole is biased.
  Series s = test::WhiteInput(6000, 1, 1, 26);
  std::mt19937_64 random(27);
  std::normal_distribution<double> normal(0.0, 0.5);
  double before = 0.0;
  for (Eigen::Index k = 1; k < s.rows(); ++k) {
    const double e = normal(random);
    s.output(k, 0) = 0.9 * s.output(k - 1, 0) + s.input(k - 1, 0) + e + 0.8 * before;
    before = e;
  }
  NarxOptions options;
  options.layout.output_lags = 1;
  options.layout.input_lags = 1;
  options.degree = 1;
  options.most_terms = 2;
  const double biased = Found(FitNarx(s, options).model).at("y1(k-1)");
  options.layout.error_lags = 1;
  const auto found = Found(FitNarx(s, options).model);
  EXPECT_GT(std::abs(biased - 0.9), 0.02);
  // Five standard deviations of some 0.003 (pole) and 0.01 (noise zero).
  EXPECT_NEAR(found.at("y1(k-1)"), 0.9, 0.015);
  EXPECT_NEAR(found.at("e1(k-1)"), 0.8, 0.05);
}

}  // namespace
}  // namespace levitas::identification

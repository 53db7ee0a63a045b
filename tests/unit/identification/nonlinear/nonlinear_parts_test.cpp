// Windows, features and their gradients, measures of fit, refinement and the oscillator's reading:
// each against a closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "identification/nonlinear/frols.hpp"
#include "identification/nonlinear/grey_box.hpp"
#include "identification/nonlinear/refine.hpp"
#include "tests/unit/identification/nonlinear/synthetic_series.hpp"

namespace levitas::identification {
namespace {

using Index = Eigen::Index;

TEST(WindowLayout, EntriesAreTheLagsThatTheirNamesSay) {
  const WindowLayout layout{.outputs = 2,
                            .inputs = 2,
                            .output_lags = 3,
                            .input_lags = 2,
                            .input_delay = 2,
                            .error_lags = 1};
  const Series s = test::WhiteInput(20, 2, 2, 1);
  LaggedModel model{layout, Eigen::VectorXd::Ones(2), Eigen::VectorXd::Ones(2), {}, {}};
  const Eigen::MatrixXd output = s.input.array() + 10.0;
  const Eigen::MatrixXd error = s.input.array() + 20.0;
  Eigen::VectorXd window(layout.size());
  constexpr Index kRow = 9;
  FillWindow(model, s.input, output, error, kRow, window);
  ASSERT_EQ(layout.size(), 2 * 3 + 2 * 2 + 2);
  ASSERT_EQ(layout.Memory(), 3);  // as many as y needs; u needs delay 2 and one more
  for (Index o = 0; o < 2; ++o) {
    for (Index lag = 1; lag <= 3; ++lag) {
      EXPECT_EQ(window[layout.y(o, lag)], output(kRow - lag, o));
    }
    for (Index lag = 2; lag <= 3; ++lag) {
      EXPECT_EQ(window[layout.u(o, lag)], s.input(kRow - lag, o));
    }
    EXPECT_EQ(window[layout.error_at() + o], error(kRow - 1, o));
  }
  const auto name = [&](std::vector<Index> factors) {
    return FeatureName(layout, Feature{.factors = std::move(factors)});
  };
  EXPECT_EQ(name({}), "1");
  EXPECT_EQ(name({layout.u(1, 2), layout.y(1, 3), layout.y(1, 3)}), "y2(k-3)^2 u2(k-2)");
  EXPECT_EQ(name({layout.error_at() + 1}), "e2(k-1)");
}

TEST(Feature, GradientIsThatOfFiniteDifferences) {
  const Eigen::VectorXd window = Eigen::Vector4d(0.3, -0.7, 1.2, 0.4);
  const std::vector<Feature> features{
      {},
      {.factors = {2}},
      {.factors = {1, 1, 1}},
      {.factors = {0, 2, 2, 3}},
      {.weights = Eigen::Vector4d(0.5, -1.0, 0.2, 0.0), .bias = 0.3}};
  for (std::size_t n = 0; n < features.size(); ++n) {
    Eigen::VectorXd gradient = Eigen::VectorXd::Constant(4, 7.0);
    features[n].AddGradient(window, 2.5, gradient);
    for (Index i = 0; i < 4; ++i) {
      constexpr double kStep = 1e-5;
      Eigen::VectorXd above = window;
      Eigen::VectorXd below = window;
      above[i] += kStep;
      below[i] -= kStep;
      const double slope = (features[n].Value(above) - features[n].Value(below)) / (2.0 * kStep);
      // Added to what was there; curvature of order one times the square of the step.
      EXPECT_NEAR(gradient[i], 7.0 + 2.5 * slope, 1e-8) << "feature " << n << ", entry " << i;
    }
  }
}

TEST(FitPercent, ComparesWhatVariesAndRmsErrorAlsoWhatStands) {
  Eigen::MatrixXd y(400, 1);
  for (Index k = 0; k < 400; ++k) {
    y(k, 0) = 3.0 + std::sin(2.0 * std::numbers::pi * static_cast<double>(k) / 100.0);
  }
  y.topRows(100).array() += 50.0;  // skipped
  const Eigen::MatrixXd shifted = y.array() + 5.0;
  EXPECT_NEAR(FitPercent(y, shifted, 100)[0], 100.0, 1e-9);
  EXPECT_NEAR(RmsError(y, shifted, 100)[0], 5.0, 1e-12);
  // The mean of the data explains nothing; 0.9 of what varies leaves a tenth.
  EXPECT_NEAR(FitPercent(y, Eigen::MatrixXd::Constant(400, 1, 3.0), 100)[0], 0.0, 1e-9);
  const Eigen::MatrixXd smaller = 3.0 + 0.9 * (y.array() - 3.0);
  EXPECT_NEAR(FitPercent(y, smaller, 100)[0], 90.0, 1e-9);
  // An error in quadrature and as large as the data: sqrt(1 + 1) of it in the difference.
  Eigen::MatrixXd late(400, 1);
  for (Index k = 0; k < 400; ++k) {
    late(k, 0) = std::cos(2.0 * std::numbers::pi * static_cast<double>(k) / 100.0);
  }
  EXPECT_NEAR(FitPercent(y, late, 100)[0], 100.0 * (1.0 - std::numbers::sqrt2), 1e-9);
}

/// y_k = a y_{k-1} + b u_{k-1}, white noise on the reading alone.
Series FirstOrder(double a, double b, double noise, std::uint64_t seed) {
  Series s = test::WhiteInput(600, 1, 1, seed);
  for (Index k = 1; k < s.rows(); ++k) {
    s.output(k, 0) = a * s.output(k - 1, 0) + b * s.input(k - 1, 0);
  }
  std::mt19937_64 random(seed + 77);
  std::normal_distribution<double> normal(0.0, noise);
  for (Index k = 0; k < s.rows(); ++k) s.output(k, 0) += normal(random);
  return s;
}

LaggedModel StartOf(const Series& series, Index output_lags, double a, double b) {
  LaggedModel model = EmptyModel({.output_lags = output_lags, .input_lags = 1}, series);
  if (output_lags > 0) model.features[0].push_back({.factors = {model.layout.y(0, 1)}});
  model.features[0].push_back({.factors = {model.layout.u(0, 1)}});
  model.theta[0].resize(static_cast<Index>(model.features[0].size()));
  if (output_lags > 0) model.theta[0][0] = a;
  model.theta[0][model.theta[0].size() - 1] = b * model.input_scale[0] / model.output_scale[0];
  return model;
}

TEST(RefineFreeRun, EndsWhereNoCoefficientCanMoveWithoutAWorseRun) {
  const Series series = FirstOrder(0.9, 0.2, 0.05, 3);
  const Refinement found = RefineFreeRun(StartOf(series, 1, 0.8, 0.25), series);
  EXPECT_TRUE(found.converged);
  EXPECT_LT(found.rms_after, found.rms_before);
  for (Index j = 0; j < 2; ++j) {
    for (const double way : {-1.0, 1.0}) {
      LaggedModel moved = found.model;
      moved.theta[0][j] += way * found.deviation[j];
      // One step of nothing: the rms of the moved model by itself.
      const Refinement worse = RefineFreeRun(moved, series, {.most_iterations = 0});
      EXPECT_GT(worse.rms_before, found.rms_after) << j << " " << way;
    }
  }
}

TEST(RefineFreeRun, DeviationsAreThoseOfTheErrorsOverManyRecords) {
  double square = 0.0;
  constexpr int kRecords = 60;
  for (int n = 0; n < kRecords; ++n) {
    const Series series = FirstOrder(0.9, 0.2, 0.05, static_cast<std::uint64_t>(200 + n));
    const Refinement found = RefineFreeRun(StartOf(series, 1, 0.88, 0.2), series);
    const double scale = found.model.output_scale[0] / found.model.input_scale[0];
    const double a = (found.model.theta[0][0] - 0.9) / found.deviation[0];
    const double b = (found.model.theta[0][1] - 0.2 / scale) / found.deviation[1];
    square += (a * a + b * b) / (2.0 * kRecords);
  }
  // 120 normal errors, of which two of a record are correlated: at most 60 independent pairs, 18 %
  // of one sigma; three of them.
  EXPECT_NEAR(square, 1.0, 0.55);
}

TEST(RefineFreeRun, AModelWithoutOutputLagsIsLinearLeastSquares) {
  Series series = test::WhiteInput(300, 1, 1, 9);
  std::mt19937_64 random(10);
  std::normal_distribution<double> normal(0.0, 0.1);
  double top = 0.0;
  double bottom = 0.0;
  for (Index k = 1; k < series.rows(); ++k) {
    series.output(k, 0) = 0.7 * series.input(k - 1, 0) + normal(random);
    if (k < 50) continue;  // RefineOptions::skip
    top += series.output(k, 0) * series.input(k - 1, 0);
    bottom += series.input(k - 1, 0) * series.input(k - 1, 0);
  }
  const Refinement found = RefineFreeRun(StartOf(series, 0, 0.0, 0.5), series);
  const double b =
      found.model.theta[0][0] * found.model.output_scale[0] / found.model.input_scale[0];
  EXPECT_NEAR(b, top / bottom, 1e-6);  // the search's last gain of 1e-7 in the sum of squares
}

/// m y'' = u - w^2 y - 2 z w y' with the input held over a sample, exactly.
Series Sampled(double frequency_hz, double damping, double gain, double period_s) {
  Series s = test::WhiteInput(3000, 1, 1, 31);
  s.period_s = period_s;
  s.input.row(0).setZero();
  const double w = 2.0 * std::numbers::pi * frequency_hz;
  const double wd = w * std::sqrt(1.0 - damping * damping);
  const double decay = std::exp(-damping * w * period_s);
  const double c = std::cos(wd * period_s);
  const double d = std::sin(wd * period_s);
  double y = 0.0;
  double v = 0.0;
  for (Index k = 1; k < s.rows(); ++k) {
    const double rest = gain * s.input(k - 1, 0) / (w * w);
    const double x = y - rest;
    y = rest + decay * (x * c + (v + damping * w * x) / wd * d);
    v = decay * (v * c - (w * w * x + damping * w * v) / wd * d);
    s.output(k, 0) = y;
  }
  return s;
}

class OscillatorTest : public testing::TestWithParam<double> {};

TEST_P(OscillatorTest, ReadsFrequencyDampingAndStiffnessOfASampledOne) {
  const double damping = GetParam();
  const Oscillator found = FitOscillator(Sampled(40.0, damping, 5.0, 1e-3), {.degree = 1});
  EXPECT_NEAR(found.frequency_hz, 40.0, 1e-4);
  EXPECT_NEAR(found.damping_ratio, damping, 1e-6);
  // At rest g u = w^2 y.
  const double stiffness = std::pow(2.0 * std::numbers::pi * 40.0, 2.0) / 5.0;
  EXPECT_NEAR(found.spring[1], stiffness, 1e-5 * stiffness);
  EXPECT_NEAR(found.spring[0], 0.0, 1e-6);
}

TEST_P(OscillatorTest, WithASlowerClockTheSameDataAreASlowerOscillator) {
  Series series = Sampled(40.0, GetParam(), 5.0, 1e-3);
  series.period_s = 4e-3;
  const Oscillator found = FitOscillator(series, {.degree = 1});
  EXPECT_NEAR(found.frequency_hz, 10.0, 1e-4);
  EXPECT_NEAR(found.damping_ratio, GetParam(), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Dampings, OscillatorTest, testing::Values(0.01, 0.1, 0.5));

TEST(Oscillator, OutputInOtherUnitsScalesItsSpringByPowers) {
  const Series series = test::CubicSystem(2000, 0.0, 42);
  Series millimetres = series;
  millimetres.output *= 1000.0;
  const Oscillator one = FitOscillator(series, {});
  const Oscillator other = FitOscillator(millimetres, {});
  for (Index n = 1; n <= 3; ++n) {
    // u = sum s_n y^n: s_n falls by 1000^n; both searches end within 1e-7 of the sum of squares.
    EXPECT_NEAR(other.spring[n] * std::pow(1000.0, static_cast<double>(n)), one.spring[n],
                1e-3 * std::abs(one.spring[1]))
        << n;
  }
  EXPECT_NEAR(other.frequency_hz, one.frequency_hz, 1e-3 * one.frequency_hz);
}

TEST(SelectTerms, StopsWhereTheRestExplainsLessThanAsked) {
  const Series s = test::WhiteInput(2000, 4, 1, 51);
  const Eigen::VectorXd target = s.input.col(2) + 0.1 * s.input.col(0);
  // Uniform inputs of one power: the second explains 0.01/1.01 of the target.
  EXPECT_EQ(SelectTerms(s.input, target, {.least_ratio = 0.02}).chosen.size(), 1U);
  EXPECT_EQ(SelectTerms(s.input, target, {.least_ratio = 0.005}).chosen,
            (std::vector<Index>{2, 0}));
}

TEST(SelectTerms, CompulsoryColumnsComeFirstWhateverTheyExplain) {
  const Series s = test::WhiteInput(500, 4, 1, 52);
  const Eigen::VectorXd target = 3.0 * s.input.col(1);
  const FrolsResult r = SelectTerms(s.input, target, {.most_terms = 2, .compulsory = {3}});
  EXPECT_EQ(r.chosen, (std::vector<Index>{3, 1}));
  EXPECT_NEAR(r.theta[0], 0.0, 1e-12);
  EXPECT_NEAR(r.theta[1], 3.0, 1e-12);
}

TEST(SelectTerms, ColumnsInOtherUnitsAreChosenAlike) {
  const Series s = test::WhiteInput(500, 5, 1, 53);
  const Eigen::VectorXd target =
      s.input * (Eigen::VectorXd(5) << 0.3, -1.0, 0.5, 0.0, 0.1).finished();
  const FrolsResult plain = SelectTerms(s.input, target, {.most_terms = 4});
  Eigen::MatrixXd scaled = s.input;
  const Eigen::VectorXd unit = (Eigen::VectorXd(5) << 1e6, 1e-3, 1.0, 1e3, 1e-6).finished();
  scaled *= unit.asDiagonal();
  const FrolsResult other = SelectTerms(scaled, target, {.most_terms = 4});
  ASSERT_EQ(other.chosen, plain.chosen);
  for (std::size_t n = 0; n < plain.chosen.size(); ++n) {
    EXPECT_NEAR(other.ratio[n], plain.ratio[n], 1e-12);
    EXPECT_NEAR(other.theta[static_cast<Index>(n)] * unit[plain.chosen[n]],
                plain.theta[static_cast<Index>(n)], 1e-9);
  }
}

}  // namespace
}  // namespace levitas::identification

// The recursion fed row by row: a system of its structure is found; gaps, pauses and jumps.
#include "identification/nonlinear/online_recursion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "tests/unit/identification/nonlinear/synthetic_series.hpp"

namespace levitas::identification {
namespace {

using Index = Eigen::Index;

constexpr Index kWindow = 100;
constexpr double kA1 = 1.6;
constexpr double kA2 = -0.7;
constexpr double kB1 = 0.1;
constexpr double kB3 = 0.05;

/// x+ = 1.6 x - 0.7 x_before + 0.1 u + 0.05 u^3, measured exactly.
Series CubicInput(Index rows, std::uint64_t seed = 51) {
  Series s = test::WhiteInput(rows, 1, 1, seed);
  for (Index k = 1; k < rows; ++k) {
    const double u = s.input(k - 1, 0);
    s.output(k, 0) = kA1 * s.output(k - 1, 0) + (k > 1 ? kA2 * s.output(k - 2, 0) : 0.0) + kB1 * u +
                     kB3 * u * u * u;
  }
  return s;
}

OnlineOptions CubicOptions() {
  OnlineOptions options{{}, 1, 1, 1e-3, kWindow};
  options.model.order = 2;
  options.model.noise_order = 0;  // exact data have none
  options.model.start_variance = 1e8;
  return options;
}

void Feed(OnlineRecursion& online, const Series& s, Index from, Index to, std::uint64_t shift = 0) {
  for (Index k = from; k < to; ++k) {
    online.Take(static_cast<std::uint64_t>(k) + shift, s.input.row(k).transpose(),
                s.output.row(k).transpose());
  }
}

/// Largest deviation of a parameter from the system's own, in scaled units.
double Deviation(const HammersteinWienerModel& m) {
  const double u = m.input_scale[0];
  const double y = m.output_scale[0];
  // Rows: two lags of v, two each of u, u^2 and u^3, the constant.
  Eigen::VectorXd truth = Eigen::VectorXd::Zero(m.theta.rows());
  truth[0] = kA1;
  truth[1] = kA2;
  truth[2] = kB1 * u / y;
  truth[6] = kB3 * u * u * u / y;
  return (m.theta.col(0) - truth).cwiseAbs().maxCoeff();
}

// What the start's variance of 1e8 leaves of exact data after some hundred rows.
constexpr double kExact = 1e-5;

TEST(OnlineRecursion, ComesToRestAtTheParametersOfAKnownSystem) {
  std::vector<ConvergencePoint> points;
  OnlineRecursion online(CubicOptions(), [&](const auto& point) { points.push_back(point); });
  Feed(online, CubicInput(1000), 0, 1000);
  EXPECT_LT(Deviation(*online.model()), kExact);
  ASSERT_FALSE(points.empty());
  EXPECT_FALSE(points.front().converged);  // all of the first window's change is from nothing
  EXPECT_GT(points.front().change, 0.5);
  EXPECT_TRUE(points.back().converged);
  EXPECT_LT(points.back().change, 1e-5);
  EXPECT_GT(points.back().fit_percent[0], 99.9);
  ASSERT_TRUE(online.rows_to_converge());
  EXPECT_LT(*online.rows_to_converge(), 1000U);
}

TEST(OnlineRecursion, WithNoiseTheErrorIsThatNoiseAndTheChangeFalls) {
  Series s = CubicInput(6000);
  std::mt19937_64 random(52);
  std::normal_distribution<double> normal(0.0, 1.0);
  constexpr double kNoise = 0.01;
  // Noise of the equation, which runs through the system: the next row knows of it.
  for (Index k = 2; k < s.rows(); ++k) {
    const double u = s.input(k - 1, 0);
    s.output(k, 0) = kA1 * s.output(k - 1, 0) + kA2 * s.output(k - 2, 0) + kB1 * u +
                     kB3 * u * u * u + kNoise * normal(random);
  }
  std::vector<ConvergencePoint> points;
  OnlineRecursion online(CubicOptions(), [&](const auto& point) { points.push_back(point); });
  Feed(online, s, 0, s.rows());
  ASSERT_GT(points.size(), 50U);
  double sum = 0.0;
  for (std::size_t i = points.size() - 50; i < points.size(); ++i) {
    sum += std::pow(points[i].error_rms[0], 2);
  }
  // Of 5000 samples the rms is known to 1 %, five times over.
  EXPECT_NEAR(std::sqrt(sum / 50.0), kNoise, 0.05 * kNoise);
  EXPECT_LT(points.back().change, points[1].change);
}

TEST(OnlineRecursion, TooFewRowsAreNotCalledConverged) {
  OnlineOptions options = CubicOptions();
  options.window_rows = 20;
  std::vector<ConvergencePoint> points;
  OnlineRecursion online(options, [&](const auto& point) { points.push_back(point); });
  Feed(online, CubicInput(160), 0, 160);
  for (const ConvergencePoint& point : points) {
    const bool enough = point.rows >= 90;  // nine regressors
    EXPECT_EQ(point.converged, enough && point.change <= 0.01) << point.rows;
  }
  EXPECT_LT(points[2].change, 0.01);  // still, but of 60 rows
  EXPECT_FALSE(points[2].converged);
}

TEST(OnlineRecursion, AGapThatIsTakenForNoneSpoilsTheParametersAndOneThatIsSeenDoesNot) {
  const Series s = CubicInput(1000);
  OnlineRecursion seen(CubicOptions());
  OnlineRecursion bridged(CubicOptions());
  Feed(seen, s, 0, 500);
  Feed(seen, s, 507, 1000);
  Feed(bridged, s, 0, 500);
  for (Index k = 507; k < 1000; ++k) {
    bridged.Take(static_cast<std::uint64_t>(k - 7), s.input.row(k).transpose(),
                 s.output.row(k).transpose());
  }
  EXPECT_EQ(seen.counts().gaps, 1U);
  EXPECT_EQ(seen.counts().missing, 7U);
  EXPECT_EQ(bridged.counts().gaps, 0U);
  EXPECT_LT(Deviation(*seen.model()), kExact);
  EXPECT_GT(Deviation(*bridged.model()), 100.0 * kExact);
}

TEST(OnlineRecursion, ARowThatIsNoNumberIsMissingAndAPauseIsNot) {
  Series s = CubicInput(600);
  OnlineRecursion online(CubicOptions());
  s.output(300, 0) = std::numeric_limits<double>::quiet_NaN();
  Feed(online, s, 0, 400);
  online.Pause();
  Feed(online, s, 450, 600);
  EXPECT_EQ(online.counts().gaps, 1U);
  EXPECT_EQ(online.counts().missing, 1U);
  EXPECT_EQ(online.counts().pauses, 1U);
  EXPECT_EQ(online.counts().learnt + online.counts().filled, 549U);
  EXPECT_LT(Deviation(*online.model()), kExact);
}

TEST(OnlineRecursion, SignalsThatSwellTenfoldBeginItAnewWithTheirScales) {
  Series s = CubicInput(1200);
  // Before row 400 hardly anything moves, as before a test signal begins.
  s.input.topRows(400) *= 1e-3;
  for (Index k = 2; k < s.rows(); ++k) {
    const double u = s.input(k - 1, 0);
    s.output(k, 0) =
        kA1 * s.output(k - 1, 0) + kA2 * s.output(k - 2, 0) + kB1 * u + kB3 * u * u * u;
  }
  OnlineRecursion online(CubicOptions());
  Feed(online, s, 0, s.rows());
  // The first look may fall into the first loud rows, while the output still rises: once more then.
  EXPECT_GE(online.counts().begun_anew, 1U);
  EXPECT_LE(online.counts().begun_anew, 2U);
  EXPECT_LT(Deviation(*online.model()), kExact);
  const double loud =
      s.output.bottomRows(700).norm() / std::sqrt(700.0);  // of the rows in which it has risen
  EXPECT_GT(online.model()->output_scale[0], loud / OnlineRecursion::kSwell);
  // Uniform in +-1 has an rms of 0.58; of the looked at rows a part may have been the quiet ones.
  EXPECT_GT(online.model()->input_scale[0], 0.58 / OnlineRecursion::kSwell);
  EXPECT_LT(online.model()->input_scale[0], 0.7);
}

TEST(OnlineRecursion, SignalsThatNeverChangeTeachNothing) {
  Series s = CubicInput(300);
  s.input.setConstant(0.2);
  OnlineRecursion online(CubicOptions());
  Feed(online, s, 0, 300);
  online.Finish();
  EXPECT_EQ(online.model(), nullptr);
}

TEST(OnlineRecursion, RegressorsHaveNames) {
  OnlineRecursion online(CubicOptions());
  Feed(online, CubicInput(200), 0, 200);
  const HammersteinWienerModel& model = *online.model();
  EXPECT_EQ(RegressorName(model, 1, {"ux"}), "position ux, section 2");
  EXPECT_EQ(RegressorName(model, 2, {"ux"}), "current ux, section 1");
  EXPECT_EQ(RegressorName(model, 7, {"ux"}), "current ux^3, section 2");
  EXPECT_EQ(RegressorName(model, 8, {"ux"}), "constant");
}

TEST(OnlineRecursion, RefusesSizesThatDoNotFit) {
  OnlineOptions options = CubicOptions();
  options.model.sensors.resize(2);
  EXPECT_THROW(OnlineRecursion{options}, std::invalid_argument);
}

}  // namespace
}  // namespace levitas::identification

// Hammerstein-Wiener by recursion: a system of exactly that structure, and what surrounds it.
#include "identification/nonlinear/hammerstein_wiener.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "common/problem.hpp"
#include "identification/nonlinear/laguerre.hpp"
#include "tests/support/allocation_guard.hpp"
#include "tests/unit/identification/nonlinear/synthetic_series.hpp"

namespace levitas::identification {
namespace {

constexpr SensorCharacteristic kSensor{0.05, 0.02};

/// Two inputs through u + 0.3 u^3, coupled second-order dynamics, a curved sensor on each output.
Series Known(Eigen::Index rows, double noise, std::uint64_t seed) {
  Series s = test::WhiteInput(rows, 2, 2, seed);
  s.input.row(0).setZero();  // at rest before the first row, or that row is no data of the system
  Eigen::MatrixXd x = Eigen::MatrixXd::Zero(rows, 2);
  const auto h = [&](Eigen::Index k, Eigen::Index i) {
    const double u = s.input(k, i);
    return u + 0.3 * u * u * u;
  };
  std::mt19937_64 random(seed + 500);
  std::normal_distribution<double> normal(0.0, 1.0);
  for (Eigen::Index k = 2; k < rows; ++k) {
    for (Eigen::Index o = 0; o < 2; ++o) {
      x(k, o) = 1.6 * x(k - 1, o) - 0.7 * x(k - 2, o) + 0.05 * x(k - 1, 1 - o) + 0.1 * h(k - 1, o) +
                0.04 * h(k - 2, 1 - o);
    }
  }
  for (Eigen::Index k = 0; k < rows; ++k) {
    for (Eigen::Index o = 0; o < 2; ++o) {
      s.output(k, o) = kSensor.Read(x(k, o) + noise * normal(random));
    }
  }
  return s;
}

HammersteinWienerOptions Options(double bandwidth_hz) {
  HammersteinWienerOptions options;
  options.order = 2;  // the system's own: one more would leave directions that no exact data tell
  options.bandwidth_hz = bandwidth_hz;
  options.sensors = {kSensor, kSensor};
  options.start_variance = 1e8;
  return options;
}

TEST(Laguerre, ImpulseResponsesAreOrthonormal) {
  Eigen::VectorXd bank = Eigen::VectorXd::Zero(5);
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(5, 5);
  for (int k = 0; k < 400; ++k) {
    PushLaguerre(0.8, k == 0 ? 1.0 : 0.0, bank);
    gram += bank * bank.transpose();
  }
  // 0.8^800 is nothing: rounding only.
  EXPECT_LT((gram - Eigen::MatrixXd::Identity(5, 5)).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(Laguerre, WithPoleZeroItHoldsThePlainLags) {
  Eigen::VectorXd bank = Eigen::VectorXd::Zero(3);
  for (const double value : {1.0, 2.0, 3.0, 4.0}) PushLaguerre(0.0, value, bank);
  EXPECT_EQ(bank, Eigen::Vector3d(4.0, 3.0, 2.0));
}

TEST(SensorCharacteristic, InvertUndoesRead) {
  for (const double x : {-1.0, -0.2, 0.0, 1e-9, 0.5, 1.0}) {
    EXPECT_NEAR(kSensor.Invert(kSensor.Read(x)), x, 1e-15);  // an ulp of 1
  }
}

TEST(HammersteinWiener, FreeRunRepeatsASystemOfItsStructureItHasNotSeen) {
  const HammersteinWienerFit fit = FitHammersteinWiener(Known(6000, 0.0, 31), Options(0.0));
  const Series fresh = Known(2000, 0.0, 32);
  const auto percent = FitPercent(fresh.output, SimulateFreeRun(fit.model, fresh).output, 50);
  // Exact data; what the start's variance (1e8) leaves is below 1e-6 of the coefficients.
  EXPECT_GT(percent.minCoeff(), 99.99);
}

TEST(HammersteinWiener, CurveOfTheInputsIsThatOfTheSystem) {
  const HammersteinWienerFit fit = FitHammersteinWiener(Known(6000, 0.0, 31), Options(0.0));
  for (Eigen::Index i = 0; i < 2; ++i) {
    const InputCurve curve = Curves(fit.model)[static_cast<std::size_t>(i)];
    const double scale = fit.model.input_scale[i];
    EXPECT_NEAR(curve.power[1], 0.0, 1e-4);
    EXPECT_NEAR(curve.power[2], 0.3 * scale * scale, 1e-4);
    EXPECT_GT(curve.share, 1.0 - 1e-6);
  }
}

TEST(HammersteinWiener, ALinearModelOfTheSameDataIsWorse) {
  HammersteinWienerOptions linear = Options(0.0);
  linear.degree = 1;
  linear.sensors.clear();
  const Series fresh = Known(2000, 0.0, 32);
  const HammersteinWienerFit fit = FitHammersteinWiener(Known(6000, 0.0, 31), linear);
  EXPECT_LT(FitPercent(fresh.output, SimulateFreeRun(fit.model, fresh).output, 50).maxCoeff(),
            97.0);
}

TEST(HammersteinWiener, WithNoiseTheFreeRunComesNearTheNoiseCeiling) {
  HammersteinWienerOptions options = Options(150.0);  // 1 kHz sampling: the poles are near 50 Hz
  options.order = 5;
  const HammersteinWienerFit fit = FitHammersteinWiener(Known(20'000, 0.02, 33), options);
  const Series fresh = Known(4000, 0.02, 34);
  const Series truth = Known(4000, 0.0, 34);
  const auto found = FitPercent(fresh.output, SimulateFreeRun(fit.model, fresh).output, 50);
  const auto ceiling = FitPercent(fresh.output, truth.output, 50);
  // Some 70 coefficients from 20 000 samples cost sqrt(1 + 70/20000) - 1 = 0.2 % of the noise, 0.01
  // points; as much again for extended least squares not being maximum likelihood, ten times over.
  EXPECT_GT((found - ceiling).minCoeff(), -0.3);
}

TEST(HammersteinWiener, OnlineAndOfflineAreTheSameRecursion) {
  const Series s = Known(3000, 0.01, 35);
  HammersteinWienerOptions options = Options(0.0);
  options.most_passes = 1;
  const HammersteinWienerFit offline = FitHammersteinWiener(s, options);
  RecursiveHammersteinWiener online(EmptyHammersteinWiener(s, options), options.start_variance);
  for (Eigen::Index k = 0; k < s.rows(); ++k) {
    (void)online.Step(s.input.row(k).transpose(), s.output.row(k).transpose());
  }
  EXPECT_EQ(online.model().theta, offline.model.theta);
}

TEST(HammersteinWiener, AStepOfTheRecursionDoesNotAllocate) {
  const Series s = Known(200, 0.01, 36);
  RecursiveHammersteinWiener online(EmptyHammersteinWiener(s, Options(100.0)), 1e4);
  Eigen::VectorXd u = s.input.row(0).transpose();
  Eigen::VectorXd y = s.output.row(0).transpose();
  const test::AllocationGuard guard;
  for (Eigen::Index k = 0; k < s.rows(); ++k) {
    u = s.input.row(k).transpose();
    y = s.output.row(k).transpose();
    (void)online.Step(u, y);
  }
  EXPECT_EQ(guard.count(), 0U);
}

constexpr double kLagHz = 100.0;

/// One axis whose force has i^2 x and i^3, i the input a lag and two samples late.
Series WithProducts(Eigen::Index rows, std::uint64_t seed) {
  Series s = test::WhiteInput(rows, 1, 1, seed);
  s.input.topRows(2).setZero();
  s.output.setZero();
  const double lag = std::exp(-2.0 * std::numbers::pi * kLagHz * s.period_s);
  double i = 0.0;
  for (Eigen::Index k = 2; k < rows; ++k) {
    const double x = s.output(k - 1, 0);
    s.output(k, 0) = 1.6 * x - 0.7 * s.output(k - 2, 0) + 0.1 * s.input(k - 1, 0) -
                     0.05 * i * i * x + 0.05 * i * i * i;
    i = lag * i + (1.0 - lag) * (k > 2 ? s.input(k - 3, 0) : 0.0);
  }
  return s;
}

TEST(HammersteinWiener, WithProductsItRepeatsAForceOfCurrentAndPosition) {
  HammersteinWienerOptions options;
  options.order = 2;
  options.degree = 1;
  options.start_variance = 1e8;
  options.input_lag_hz = kLagHz;
  options.input_delay = 2;
  const Series data = WithProducts(6000, 41);
  const Series fresh = WithProducts(2000, 42);
  const auto percent = [&](bool products) {
    options.products = products;
    const auto fit = FitHammersteinWiener(data, options);
    return FitPercent(fresh.output, SimulateFreeRun(fit.model, fresh).output, 50)[0];
  };
  EXPECT_GT(percent(true), 99.99);  // exact data, its own structure
  EXPECT_LT(percent(false), 99.0);
}

TEST(HammersteinWiener, AStepWithProductsDoesNotAllocate) {
  const Series s = WithProducts(200, 43);
  HammersteinWienerOptions options = Options(100.0);
  options.products = true;
  options.input_delay = 1;
  options.sensors.clear();
  RecursiveHammersteinWiener online(EmptyHammersteinWiener(s, options), 1e4);
  Eigen::VectorXd u = s.input.row(0).transpose();
  Eigen::VectorXd y = s.output.row(0).transpose();
  const test::AllocationGuard guard;
  for (Eigen::Index k = 0; k < s.rows(); ++k) {
    u = s.input.row(k).transpose();
    y = s.output.row(k).transpose();
    (void)online.Step(u, y);
  }
  EXPECT_EQ(guard.count(), 0U);
}

TEST(HammersteinWiener, ProductsOfOneInputAndTwoOutputsAreRefused) {
  HammersteinWienerOptions options;
  options.products = true;
  EXPECT_THROW((void)FitHammersteinWiener(test::WhiteInput(1000, 1, 2, 44), options), BadInput);
}

TEST(HammersteinWiener, ASampleThatIsNoNumberIsLeftOutAndCounted) {
  const Series s = Known(500, 0.01, 37);
  RecursiveHammersteinWiener online(EmptyHammersteinWiener(s, Options(0.0)), 1e4);
  Eigen::VectorXd y = s.output.row(3).transpose();
  y[0] = std::nan("");
  (void)online.Step(s.input.row(3).transpose(), y);
  EXPECT_EQ(online.skipped(), 1U);
  EXPECT_TRUE(online.model().theta.allFinite());
}

TEST(HammersteinWiener, AnUnstableSystemRunsFreelyInsideItsLoop) {
  // x+ = 1.05 x + 0.1 (u + e), u = -2 x: stable in the loop only.
  Series s = test::WhiteInput(4000, 1, 1, 38);
  const Eigen::VectorXd e = s.input.col(0);
  double x = 0.0;
  for (Eigen::Index k = 0; k < s.rows(); ++k) {
    s.output(k, 0) = x;
    s.input(k, 0) = -2.0 * x + e[k];
    x = 1.05 * x + 0.1 * s.input(k, 0);
  }
  HammersteinWienerOptions options;
  options.order = 1;
  options.degree = 1;
  const HammersteinWienerFit fit = FitHammersteinWiener(s, options);
  const Feedback loop = [&](Eigen::Index row, const Eigen::VectorXd& y, Eigen::VectorXd& u) {
    u[0] = -2.0 * y[0] + e[row];
  };
  EXPECT_GT(FitPercent(s.output, SimulateFreeRun(fit.model, s, loop).output, 10)[0], 99.0);
}

}  // namespace
}  // namespace levitas::identification

// Levenberg-Marquardt against minima that are known in closed form.

#include "numerics/minimum/levenberg_marquardt.hpp"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <functional>
#include <random>
#include <vector>

#include "numerics/factors/factors.hpp"

namespace levitas::numerics {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

/// Residuals and their derivative as functions; remembers the cost of every point taken.
struct Residuals {
  std::function<Vector(const Vector&)> residual;
  std::function<Matrix(const Vector&)> jacobian;
  std::vector<double> taken{};

  double Cost(const Vector& x) const { return residual(x).squaredNorm(); }
  std::optional<NormalEquations> Linearise(const Iterate<Vector>& at) {
    taken.push_back(at.cost);
    const Matrix j = jacobian(at.point);
    if (j.size() == 0) return std::nullopt;
    return NormalEquations{j.transpose() * j, j.transpose() * residual(at.point)};
  }
  Iterate<Vector> Step(const Vector& from, const Vector& step) const {
    Vector next = from + step;
    const double cost = Cost(next);
    return {std::move(next), cost};
  }
  Minimum<Vector> From(const Vector& x, const LevenbergMarquardtOptions& options = {}) {
    return LevenbergMarquardt(*this, Iterate<Vector>{x, Cost(x)}, options);
  }
};

Residuals Linear(const Matrix& a, const Vector& b) {
  return {[a, b](const Vector& x) -> Vector { return a * x - b; },
          [a](const Vector&) -> Matrix { return a; }};
}

/// Rosenbrock (1960): 0 at (1, 1), at the end of a curved valley.
Residuals Rosenbrock() {
  return {[](const Vector& x) -> Vector {
            return Eigen::Vector2d(10.0 * (x[1] - x[0] * x[0]), 1.0 - x[0]);
          },
          [](const Vector& x) -> Matrix {
            return (Eigen::Matrix2d() << -20.0 * x[0], 10.0, -1.0, 0.0).finished();
          }};
}

/// Distance of (3, 4) from the circle of radius 1: 4, at the angle atan2(4, 3).
Residuals CircleDistance() {
  return {
      [](const Vector& x) -> Vector {
        return Eigen::Vector2d(std::cos(x[0]) - 3.0, std::sin(x[0]) - 4.0);
      },
      [](const Vector& x) -> Matrix { return Eigen::Vector2d(-std::sin(x[0]), std::cos(x[0])); }};
}

TEST(LevenbergMarquardt, SolvesRandomLinearProblemsAsQrDoes) {
  std::mt19937_64 draw{20261123};
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 100; ++trial) {
    const Matrix a = Matrix::NullaryExpr(12, 4, [&] { return normal(draw); });
    const Vector b = Vector::NullaryExpr(12, [&] { return normal(draw); });
    Residuals problem = Linear(a, b);
    const auto found = problem.From(Vector::Zero(4));
    const Vector exact = a.colPivHouseholderQr().solve(b);
    // Costs that differ by less than their rounding stop the search: sqrt(1e-16) in the unknowns.
    EXPECT_LT((found.at.point - exact).norm(), 1e-6 * (1.0 + exact.norm()));
    EXPECT_EQ(found.end, SearchEnd::kNoStepHelps);
  }
}

TEST(LevenbergMarquardt, FollowsACurvedValleyToItsEnd) {
  Residuals problem = Rosenbrock();
  const auto found = problem.From(Eigen::Vector2d(-1.2, 1.0));  // Rosenbrock's start
  EXPECT_LT((found.at.point - Eigen::Vector2d(1.0, 1.0)).norm(), 1e-7);
  EXPECT_LT(found.at.cost, 1e-14);
}

TEST(LevenbergMarquardt, FindsAMinimumWhoseResidualsAreLarge) {
  Residuals problem = CircleDistance();
  const auto found = problem.From(Vector::Constant(1, -1.0));
  EXPECT_NEAR(found.at.point[0], std::atan2(4.0, 3.0), 1e-7);
  EXPECT_NEAR(found.at.cost, 16.0, 1e-12);
}

TEST(LevenbergMarquardt, NeverTakesAStepThatRaisesTheCost) {
  Residuals problem = Rosenbrock();
  static_cast<void>(problem.From(Eigen::Vector2d(-1.2, 1.0)));
  ASSERT_GT(problem.taken.size(), 3U);
  for (std::size_t n = 1; n < problem.taken.size(); ++n) {
    EXPECT_LT(problem.taken[n], problem.taken[n - 1]);
  }
}

TEST(LevenbergMarquardt, TakesTheSameStepsWhateverTheUnitsOfTheUnknowns) {
  // Powers of two scale without rounding.
  const Eigen::Vector2d unit(std::ldexp(1.0, 30), std::ldexp(1.0, -20));
  Residuals plain = Rosenbrock();
  Residuals scaled{[&](const Vector& x) { return plain.residual(x.cwiseProduct(unit)); },
                   [&](const Vector& x) -> Matrix {
                     return plain.jacobian(x.cwiseProduct(unit)) * unit.asDiagonal();
                   }};
  const Eigen::Vector2d start(-1.2, 1.0);
  const LevenbergMarquardtOptions options{.most_steps = 8};
  const auto one = plain.From(start, options);
  const auto other = scaled.From(start.cwiseQuotient(unit), options);
  // Rounding alone, which the curved valley enlarges from step to step.
  EXPECT_LT((other.at.point.cwiseProduct(unit) - one.at.point).norm(), 1e-9);
}

TEST(LevenbergMarquardt, StaysWhereTheModelCanBeRun) {
  // ln x is lost below zero; an undamped step from 5 to the minimum at 1 leads there.
  Residuals problem{[](const Vector& x) -> Vector { return Vector::Constant(1, std::log(x[0])); },
                    [](const Vector& x) -> Matrix { return Matrix::Constant(1, 1, 1.0 / x[0]); }};
  ASSERT_LT(5.0 - 5.0 * std::log(5.0), 0.0);
  const auto found = problem.From(Vector::Constant(1, 5.0));
  EXPECT_NEAR(found.at.point[0], 1.0, 1e-9);
}

TEST(LevenbergMarquardt, HoldsABoundThatItsProblemKeeps) {
  // (x - 2)^2 + (y - 3)^2 with x <= 1: the minimum is (1, 3), its cost 1.
  struct Bounded {
    static double Cost(const Vector& x) { return (x - Eigen::Vector2d(2.0, 3.0)).squaredNorm(); }
    static std::optional<NormalEquations> Linearise(const Iterate<Vector>& at) {
      NormalEquations equations{Matrix::Identity(2, 2), at.point - Eigen::Vector2d(2.0, 3.0)};
      if (at.point[0] >= 1.0 && equations.gradient[0] < 0.0) equations.gradient[0] = 0.0;
      return equations;
    }
    static Iterate<Vector> Step(const Vector& from, const Vector& step) {
      Vector next = from + step;
      next[0] = std::min(next[0], 1.0);
      const double cost = Cost(next);
      return {std::move(next), cost};
    }
  } problem;
  const auto found = LevenbergMarquardt(problem, Bounded::Step(Vector::Zero(2), Vector::Zero(2)),
                                        LevenbergMarquardtOptions{});
  EXPECT_EQ(found.at.point[0], 1.0);
  EXPECT_NEAR(found.at.point[1], 3.0, 1e-7);
}

TEST(LevenbergMarquardt, SaysWhyItEnded) {
  Residuals line = Linear(Matrix::Identity(2, 2), Eigen::Vector2d(3.0, 4.0));
  const Vector zero = Vector::Zero(2);
  EXPECT_EQ(line.From(zero, {.least_gain = 100.0}).end, SearchEnd::kConverged);
  EXPECT_EQ(line.From(zero, {.least_gain = 100.0}).steps, 1);
  EXPECT_EQ(line.From(zero, {.least_relative_gain = 2.0}).end, SearchEnd::kConverged);
  // The whole cost, 25, is what an undamped step gains.
  EXPECT_EQ(line.From(zero, {.least_predicted_gain = 25.1}).steps, 0);
  EXPECT_EQ(line.From(zero, {.least_predicted_gain = 24.9}).steps, 1);
  EXPECT_EQ(line.From(zero, {.most_steps = 0}).end, SearchEnd::kMostSteps);
  EXPECT_EQ(line.From(zero, {.most_trials = 1}).steps, 1);
  line.jacobian = [](const Vector&) -> Matrix { return {}; };
  EXPECT_EQ(line.From(zero).end, SearchEnd::kNotLinear);
  line.residual = [](const Vector&) -> Vector {
    return Vector::Constant(1, std::numeric_limits<double>::infinity());
  };
  EXPECT_EQ(line.From(zero).end, SearchEnd::kInfiniteStart);
}

TEST(Damping, GivesUpAtItsLimits) {
  const LevenbergMarquardtOptions options{.first_damping = 1.0, .most_damping = 1e3};
  Damping damping(options);
  for (int n = 0; n < 3; ++n) {
    EXPECT_TRUE(damping.MayStep());
    damping.Refuse();
  }
  EXPECT_FALSE(damping.MayStep());  // 1000 is no longer below 1000
  const LevenbergMarquardtOptions twice{.most_refused = 2};
  Damping patient(twice);
  patient.Refuse();
  patient.Accept();
  patient.Refuse();
  EXPECT_TRUE(patient.MayStep());  // only in a row
  patient.Refuse();
  EXPECT_FALSE(patient.MayStep());
}

TEST(DampedStep, IsTheGaussNewtonStepWithoutDampingAndShortWithMuch) {
  const NormalEquations equations{Eigen::Vector2d(4.0, 100.0).asDiagonal(),
                                  Eigen::Vector2d(-8.0, 50.0)};
  EXPECT_TRUE(DampedStep(equations, 0.0).isApprox(Eigen::Vector2d(2.0, -0.5)));
  EXPECT_TRUE(DampedStep(equations, 9.0).isApprox(Eigen::Vector2d(0.2, -0.05)));
  EXPECT_DOUBLE_EQ(PredictedGain(equations), 8.0 * 8.0 / 4.0 + 50.0 * 50.0 / 100.0);
}

}  // namespace
}  // namespace levitas::numerics

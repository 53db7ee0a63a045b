#include "numerics/minimum/evolution_strategy.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace levitas::numerics {
namespace {

bool Always(std::size_t, double) { return true; }

TEST(EvolutionStrategy, FindsTheMinimumOfAStretchedBowl) {
  const Eigen::VectorXd wanted = Eigen::VectorXd::LinSpaced(6, -1.0, 2.0);
  const auto cost = [&](const Eigen::VectorXd& x) {
    double sum = 0.0;
    for (Eigen::Index i = 0; i < x.size(); ++i)
      sum += std::pow(10.0, static_cast<double>(i)) * std::pow(x(i) - wanted(i), 2);
    return sum;
  };
  const auto found = Evolve(Eigen::VectorXd::Zero(6), cost, {.evaluations = 4000}, Always);
  EXPECT_LT((found.best - wanted).norm(), 1e-3);
  EXPECT_LE(found.evaluations, 4000U);
}

TEST(EvolutionStrategy, FollowsRosenbrocksValley) {
  const auto cost = [](const Eigen::VectorXd& x) {
    return 100.0 * std::pow(x(1) - x(0) * x(0), 2) + std::pow(1.0 - x(0), 2);
  };
  const auto found = Evolve(Eigen::Vector2d(-1.2, 1.0), cost, {.evaluations = 3000}, Always);
  EXPECT_LT((found.best - Eigen::Vector2d::Ones()).norm(), 1e-3);
}

TEST(EvolutionStrategy, RepeatsItselfForASeedAndNotForAnother) {
  const auto cost = [](const Eigen::VectorXd& x) { return (x.array() - 1.0).square().sum(); };
  const Eigen::VectorXd start = Eigen::VectorXd::Zero(3);
  const auto one = Evolve(start, cost, {.evaluations = 60, .seed = 5}, Always);
  EXPECT_EQ(one.best, Evolve(start, cost, {.evaluations = 60, .seed = 5}, Always).best);
  EXPECT_NE(one.best, Evolve(start, cost, {.evaluations = 60, .seed = 6}, Always).best);
}

TEST(EvolutionStrategy, AnswersTheSameForAnyNumberOfThreads) {
  const auto cost = [](const Eigen::VectorXd& x) { return std::abs(x(0) - 1.0) + x.squaredNorm(); };
  const Eigen::VectorXd start = Eigen::VectorXd::Zero(4);
  // 205: the last generation is not a whole one.
  const auto one = Evolve(start, cost, {.evaluations = 205, .population = 12}, Always);
  for (const std::size_t threads : {0U, 2U, 5U}) {
    const auto many =
        Evolve(start, cost, {.evaluations = 205, .population = 12, .threads = threads}, Always);
    EXPECT_EQ(many.best, one.best) << threads;
    EXPECT_EQ(many.evaluations, 205U) << threads;
  }
}

TEST(EvolutionStrategy, NeedsNoMoreThanItsStartWhereNothingElseIsAllowed) {
  const auto cost = [](const Eigen::VectorXd& x) { return x.squaredNorm(); };
  EXPECT_EQ(Evolve(Eigen::Vector2d::Ones(), cost, {.evaluations = 1}, Always).evaluations, 1U);
}

TEST(EvolutionStrategy, StopsWhenToldAndKeepsTheBest) {
  const auto cost = [](const Eigen::VectorXd& x) { return x(0) > 0.0 ? NAN : x(0) * x(0); };
  const auto found = Evolve(Eigen::VectorXd::Constant(1, -3.0), cost, {.evaluations = 100},
                            [](std::size_t n, double) { return n < 20; });
  EXPECT_EQ(found.evaluations, 20U);
  EXPECT_LE(found.best(0), 0.0);  // a cost that is no number is never the best
}

}  // namespace
}  // namespace levitas::numerics

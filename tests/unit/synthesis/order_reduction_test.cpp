#include "design/synthesis/order_reduction.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "common/problem.hpp"
#include "design/synthesis/hinf_norm.hpp"
#include "design/synthesis/hinf_synthesis.hpp"
#include "numerics/spectra/spectra.hpp"
#include "plants.hpp"

namespace levitas::synthesis {
namespace {

double Difference(const StateSpace& a, const StateSpace& b, double rad_per_s) {
  return (Response(a, rad_per_s) - Response(b, rad_per_s)).norm();
}

TEST(SplitStable, IsASumOfADecayingAndAGrowingPart) {
  Random random(21);
  const StateSpace system{DrawMatrix(random, 7, 7), DrawMatrix(random, 7, 2),
                          DrawMatrix(random, 3, 7), DrawMatrix(random, 3, 2)};
  const SplitSystem split = SplitStable(system);
  EXPECT_GT(split.other.states(), 0);
  EXPECT_GT(split.stable.states(), 0);
  EXPECT_LT(Poles(split.stable).real().maxCoeff(), 0.0);
  EXPECT_GT(Poles(split.other).real().minCoeff(), 0.0);
  for (const double w : {0.0, 1.3, 20.0}) {
    const Eigen::MatrixXcd sum = Response(split.stable, w) + Response(split.other, w);
    EXPECT_LT((sum - Response(system, w)).norm(), 1e-9 * (1.0 + sum.norm()));
  }
}

TEST(SplitStable, KeepsAnIntegratorWithWhatDoesNotDecay) {
  StateSpace integrator = FirstOrder(1.0, 1e9, 1.0);
  integrator.A.setZero();
  const SplitSystem split = SplitStable(Append(integrator, FirstOrder(2.0, 40.0, 3.0)));
  EXPECT_EQ(split.other.states(), 1);
  EXPECT_EQ(split.stable.states(), 1);
}

TEST(BalancedTruncation, StaysWithinTwiceTheDroppedHankelValues) {
  Random random(22);
  for (int trial = 0; trial < 8; ++trial) {
    const StateSpace system = DrawStable(random, 10, 2, 3);
    const BalancedSystem balanced = Balance(system);
    for (const Eigen::Index order : {2, 5, 8}) {
      const StateSpace less = balanced.Truncated(order);
      EXPECT_EQ(less.states(), order);
      EXPECT_TRUE(IsStable(less));
      const double bound =
          2.0 * balanced.hankel_values.tail(balanced.hankel_values.size() - order).sum();
      for (int i = 0; i <= 200; ++i) {
        const double w = std::pow(10.0, -3.0 + 6.0 * i / 200.0);
        const Eigen::MatrixXcd off = Response(less, w) - Response(system, w);
        EXPECT_LE(Eigen::JacobiSVD<Eigen::MatrixXcd>(off).singularValues()(0),
                  bound * (1.0 + 1e-6) + 1e-9);
      }
    }
  }
}

TEST(BalancedTruncation, OfAFirstOrderLagHasHalfItsGainAsHankelValue) {
  // gain/(s/p + 1): P = b^2/(2 p), Q = c^2/(2 p), sqrt(P Q) = b c/(2 p) = gain/2.
  const BalancedSystem balanced = Balance(FirstOrder(3.0, 1e12, 2.0));
  ASSERT_EQ(balanced.hankel_values.size(), 1);
  EXPECT_NEAR(balanced.hankel_values(0), 1.5, 1e-9);
}

TEST(BalancedTruncation, DropsStatesThatNothingReaches) {
  StateSpace system = Append(FirstOrder(1.0, 30.0, 2.0), FirstOrder(1.0, 30.0, 5.0));
  system.B(1, 1) = 0.0;
  const BalancedSystem balanced = Balance(system);
  EXPECT_EQ(balanced.states(), 1);
  EXPECT_LT(Difference(balanced.Truncated(1), system, 3.0), 1e-12);
}

TEST(ReduceKeeping, FindsTheLowestOrderThatTheLoopAllows) {
  const GeneralisedPlant plant = FlexibleAxis();
  // Away from the smallest gamma the controller has a fast pole less to spend.
  const HinfController made = Synthesise(plant, {.relaxation = 1.1});
  const auto criterion = [&](const StateSpace& controller) {
    const StateSpace loop = LowerFeedback(plant.system, controller);
    return IsStable(loop) ? NormOf(loop).upper : INFINITY;
  };
  const double allowed = 1.05 * made.gamma;
  const ReducedController reduced = ReduceKeeping(made.controller, criterion, allowed);
  EXPECT_LT(reduced.controller.states(), made.controller.states());
  EXPECT_LE(reduced.criterion, allowed);
  EXPECT_EQ(criterion(reduced.controller), reduced.criterion);
  const StateSpace fewer = Balance(made.controller).Truncated(reduced.controller.states() - 1);
  EXPECT_GT(criterion(fewer), allowed);
}

TEST(ReduceKeeping, RefusesAControllerThatAlreadyFails) {
  const auto never = [](const StateSpace&) { return 2.0; };
  EXPECT_THROW(static_cast<void>(ReduceKeeping(FirstOrder(1.0, 30.0, 2.0), never, 1.0)), Problem);
}

}  // namespace
}  // namespace levitas::synthesis

#include "design/synthesis/state_space.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <limits>
#include <stdexcept>

#include "common/problem.hpp"
#include "numerics/dense/factorisations.hpp"
#include "plants.hpp"

namespace levitas::synthesis {
namespace {

constexpr double kRounding = 1e-10;  // of products of 5 x 5 matrices of order one

TEST(StateSpace, ResponseOfAFirstOrderLagIsItsFormula) {
  const StateSpace lag = FirstOrder(3.0, 50.0, 7.0);
  for (const double w : {0.0, 1.0, 7.0, 300.0}) {
    const std::complex<double> s(0.0, w);
    EXPECT_LT(std::abs(Response(lag, w)(0, 0) - 3.0 * (s / 50.0 + 1.0) / (s / 7.0 + 1.0)), 1e-14);
  }
  EXPECT_NEAR(Response(lag, std::numeric_limits<double>::infinity())(0, 0).real(), 3.0 * 7.0 / 50.0,
              1e-15);
}

TEST(StateSpace, SeriesMultipliesAndAppendStacks) {
  Random random(20261123);
  const StateSpace first = DrawStable(random, 3, 2, 4);
  const StateSpace second = DrawStable(random, 5, 4, 3);
  const double w = 1.7;
  const Eigen::MatrixXcd product = Response(second, w) * Response(first, w);
  EXPECT_LT((Response(Series(first, second), w) - product).norm(), kRounding);
  const Eigen::MatrixXcd both = Response(Append(first, second), w);
  EXPECT_LT((both.topLeftCorner(4, 2) - Response(first, w)).norm(), kRounding);
  EXPECT_LT((both.bottomRightCorner(3, 4) - Response(second, w)).norm(), kRounding);
  EXPECT_EQ(both.topRightCorner(4, 4).norm(), 0.0);
  EXPECT_LT((Response(Transposed(first), w) - Response(first, w).transpose()).norm(), kRounding);
}

TEST(StateSpace, LowerFeedbackIsTheLinearFractionalTransformationAtEveryFrequency) {
  Random random(20261124);
  for (int trial = 0; trial < 10; ++trial) {
    const GeneralisedPlant plant = DrawPlant(random, 4);
    const StateSpace controller = DrawStable(random, 3, 2, 2);
    const StateSpace loop = LowerFeedback(plant.system, controller);
    const double w = 10.0 * random.Uniform();
    const Eigen::MatrixXcd P = Response(plant.system, w);
    const Eigen::MatrixXcd K = Response(controller, w);
    const Eigen::MatrixXcd one = Eigen::MatrixXcd::Identity(2, 2);
    const Eigen::MatrixXcd expected =
        P.topLeftCorner(4, 4) + P.topRightCorner(4, 2) * K *
                                    (one - P.bottomRightCorner(2, 2) * K).inverse() *
                                    P.bottomLeftCorner(2, 4);
    EXPECT_LT((Response(loop, w) - expected).norm(), 1e-8 * (1.0 + expected.norm()));
  }
}

TEST(StateSpace, AnAlgebraicLoopWithoutASolutionIsRefused) {
  GeneralisedPlant plant = ScalarPlant(-1.0);
  plant.system.D(2, 2) = 2.0;
  EXPECT_THROW(
      static_cast<void>(LowerFeedback(plant.system, Gain(Eigen::MatrixXd::Constant(1, 1, 0.5)))),
      Problem);
}

TEST(StateSpace, BalancingKeepsTheResponseAndEvensTheStates) {
  StateSpace system = Append(FirstOrder(1.0, 30.0, 2.0), FirstOrder(1.0, 30.0, 5.0));
  system.A(0, 1) = 1e9;
  system.A(1, 0) = 1e-9;
  const StateSpace balanced = Balanced(system);
  EXPECT_LT((Response(balanced, 3.0) - Response(system, 3.0)).norm(),
            1e-12 * Response(system, 3.0).norm());
  EXPECT_LT(balanced.A.norm(), 1e-3 * system.A.norm());
}

TEST(StateSpace, MatricesThatDoNotFitAreRefused) {
  StateSpace system = FirstOrder(1.0, 30.0, 2.0);
  system.B = Eigen::MatrixXd::Ones(2, 1);
  EXPECT_THROW(CheckShapes(system), std::invalid_argument);
  system = FirstOrder(1.0, 30.0, 2.0);
  system.A(0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(CheckShapes(system), std::invalid_argument);
}

}  // namespace
}  // namespace levitas::synthesis

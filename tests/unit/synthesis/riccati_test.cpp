#include "design/synthesis/riccati.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "design/synthesis/matrix_sign.hpp"
#include "numerics/dense/eigenvalues.hpp"
#include "plants.hpp"

namespace levitas::synthesis {
namespace {

using Eigen::MatrixXd;

TEST(MatrixSign, OfADiagonalIsTheSignOfEachEntry) {
  Random random(5);
  const MatrixXd T = DrawMatrix(random, 4, 4);
  const Eigen::Vector4d values(3.0, -0.02, 1e4, -7e3);
  const MatrixXd M = T * values.asDiagonal() * T.inverse();
  const MatrixXd expected = T * Eigen::Vector4d(1.0, -1.0, 1.0, -1.0).asDiagonal() * T.inverse();
  const auto sign = MatrixSign(M);
  ASSERT_TRUE(sign);
  EXPECT_LT((*sign - expected).norm(), 1e-8 * expected.norm());  // eigenvalues 5e5 apart
}

TEST(MatrixSign, DoesNotExistForAnOscillator) {
  EXPECT_FALSE(MatrixSign(Eigen::Matrix2d{{0.0, 1.0}, {-4.0, 0.0}}));
}

TEST(Riccati, OfAScalarIsTheStabilisingRootOfItsQuadratic) {
  for (const double a : {-2.0, 0.0, 3.0})
    for (const double g : {1.0, -0.2}) {  // 2 a x - g x^2 + q = 0, root with a - g x < 0
      const double q = 0.7;
      const double discriminant = a * a + g * q;
      const auto x = SolveRiccati(MatrixXd::Constant(1, 1, a), MatrixXd::Constant(1, 1, g),
                                  MatrixXd::Constant(1, 1, q));
      if (discriminant <= 0.0) {
        EXPECT_FALSE(x) << a << " " << g;
        continue;
      }
      ASSERT_TRUE(x) << a << " " << g;
      const double expected = (a + std::sqrt(discriminant)) / g;
      EXPECT_NEAR((*x)(0, 0), expected, 1e-12 * std::abs(expected));
    }
}

TEST(Riccati, OfDrawnSystemsSatisfiesTheEquationAndStabilises) {
  Random random(20261125);
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::Index n = 12;
    const MatrixXd A = DrawMatrix(random, n, n);
    const MatrixXd B = DrawMatrix(random, n, 2);
    const MatrixXd C = DrawMatrix(random, 3, n);
    const MatrixXd G = B * B.transpose();
    const MatrixXd Q = C.transpose() * C;
    const auto X = SolveRiccati(A, G, Q);
    ASSERT_TRUE(X);
    const MatrixXd left = A.transpose() * *X + *X * A - *X * G * *X + Q;
    EXPECT_LT(left.norm(), 1e-10 * (*X * G * *X).norm());  // rounding after the corrections
    EXPECT_LT((A - G * *X).eigenvalues().real().maxCoeff(), 0.0);
  }
}

TEST(Riccati, HasNoStabilisingSolutionForAnUnreachableUnstableMode) {
  const MatrixXd A = Eigen::Vector2d(1.0, -1.0).asDiagonal();
  const MatrixXd G = Eigen::Vector2d(0.0, 1.0).asDiagonal();
  EXPECT_FALSE(SolveRiccati(A, G, MatrixXd::Identity(2, 2)));
}

TEST(Lyapunov, OfADiagonalIsItsClosedForm) {
  const Eigen::Vector3d a(-0.01, -2.0, -5e4);
  Random random(9);
  MatrixXd Q = DrawMatrix(random, 3, 3);
  Q = (Q + Q.transpose()).eval();
  const auto X = SolveLyapunov(a.asDiagonal(), Q);
  ASSERT_TRUE(X);
  for (Eigen::Index i = 0; i < 3; ++i)
    for (Eigen::Index j = 0; j < 3; ++j)
      EXPECT_NEAR((*X)(i, j), -Q(i, j) / (a(i) + a(j)), 1e-9 * std::abs(Q(i, j) / (a(i) + a(j))));
}

}  // namespace
}  // namespace levitas::synthesis

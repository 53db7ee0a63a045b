#include "design/synthesis/structured_singular_value.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>

#include "numerics/dense/eigenvalues.hpp"
#include "numerics/spectra/spectra.hpp"
#include "plants.hpp"

namespace levitas::synthesis {
namespace {

using Eigen::MatrixXcd;
using Complex = std::complex<double>;

constexpr UncertaintyBlock kScalar{BlockKind::kFullComplex, 1, 1};
constexpr UncertaintyBlock kReal{BlockKind::kRepeatedReal, 1, 1};

MatrixXcd DrawComplex(Random& random, Eigen::Index n) {
  return DrawMatrix(random, n, n) + Complex(0.0, 1.0) * DrawMatrix(random, n, n);
}

double LargestSingularValue(const MatrixXcd& M) {
  return Eigen::JacobiSVD<MatrixXcd>(M).singularValues()(0);
}

/// The inequality of the upper bound, checked with its own matrices.
void ExpectProven(const MatrixXcd& M, const MuUpper& upper) {
  const auto& [rows, columns, G] = upper.scaling;
  const MatrixXcd product = G * M;
  const double b = upper.value * upper.value * (1.0 + 1e-6);
  const MatrixXcd left =
      b * columns - M.adjoint() * rows * M - Complex(0.0, 1.0) * (product - product.adjoint());
  const auto least = left.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff();
  EXPECT_GE(least, -1e-7 * columns.norm() * M.squaredNorm());
  EXPECT_GT(columns.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), 0.0);
}

TEST(Mu, OfOneFullBlockIsTheLargestSingularValue) {
  Random random(1);
  const MatrixXcd M = DrawComplex(random, 4).leftCols(3);
  const UncertaintyBlocks blocks{{BlockKind::kFullComplex, 4, 3}};
  EXPECT_NEAR(MuUpperBound(M, blocks).value, LargestSingularValue(M), 1e-9);
  EXPECT_NEAR(MuLowerBound(M, blocks), LargestSingularValue(M), 1e-6);
}

TEST(Mu, OfOneRepeatedComplexScalarIsTheSpectralRadius) {
  Random random(2);
  for (int trial = 0; trial < 5; ++trial) {
    const MatrixXcd M = DrawComplex(random, 4);
    const double radius = M.eigenvalues().cwiseAbs().maxCoeff();
    const UncertaintyBlocks blocks{{BlockKind::kRepeatedComplex, 4, 4}};
    const MuUpper upper = MuUpperBound(M, blocks);
    EXPECT_GE(upper.value, radius * (1.0 - 1e-9));
    EXPECT_LE(upper.value, radius * 1.01);  // the bound is exact here; the search ends within 0.1 %
    EXPECT_NEAR(MuLowerBound(M, blocks), radius, 1e-6 * radius);
    ExpectProven(M, upper);
  }
}

TEST(Mu, OfARankOneMatrixIsTheSumOfItsProducts) {
  // M = u v*, scalar blocks: mu = sum |u_i v_i| (Packard & Doyle, Automatica 29 (1993) 71).
  Random random(3);
  const MatrixXcd u = DrawComplex(random, 5).col(0);
  const MatrixXcd v = DrawComplex(random, 5).col(0);
  const double expected = u.cwiseAbs().cwiseProduct(v.cwiseAbs()).sum();
  const MatrixXcd M = u * v.adjoint();
  const UncertaintyBlocks blocks(5, kScalar);
  EXPECT_NEAR(MuUpperBound(M, blocks).value, expected, 0.005 * expected);
  EXPECT_NEAR(MuLowerBound(M, blocks), expected, 1e-6 * expected);
}

TEST(Mu, OfThreeFullBlocksHasEqualBounds) {
  // With at most three full blocks the upper bound is exact (Packard & Doyle 1993).
  Random random(4);
  for (int trial = 0; trial < 10; ++trial) {
    const MatrixXcd M = DrawComplex(random, 5);
    const UncertaintyBlocks blocks{
        kScalar, {BlockKind::kFullComplex, 2, 3}, {BlockKind::kFullComplex, 2, 1}};
    const MuUpper upper = MuUpperBound(M, blocks);
    const double lower = MuLowerBound(M, blocks);
    EXPECT_LE(lower, upper.value * (1.0 + 1e-9));
    EXPECT_GE(lower, 0.98 * upper.value) << trial;
    ExpectProven(M, upper);
  }
}

TEST(Mu, OfARealParameterIsZeroWhereTheGainIsImaginary) {
  const UncertaintyBlocks real{kReal};
  EXPECT_LT(MuUpperBound(MatrixXcd::Constant(1, 1, Complex(0.0, 3.0)), real).value, 1e-3);
  EXPECT_NEAR(MuUpperBound(MatrixXcd::Constant(1, 1, Complex(-3.0, 0.0)), real).value, 3.0, 1e-3);
  EXPECT_NEAR(MuLowerBound(MatrixXcd::Constant(1, 1, Complex(-3.0, 0.0)), real), 3.0, 1e-9);
}

TEST(Mu, OfRealAndComplexBlocksEnclosesWhatASearchFinds) {
  // One real and one complex scalar: for each real delta the complex one needed has a closed form.
  Random random(5);
  for (int trial = 0; trial < 8; ++trial) {
    const MatrixXcd M = DrawComplex(random, 2);
    double smallest = INFINITY;
    for (int i = -20000; i <= 20000; ++i) {
      const double real = i * 1e-4 * 2.0;
      const Complex through = M(1, 1) + M(1, 0) * real * M(0, 1) / (1.0 - M(0, 0) * real);
      smallest = std::min(smallest, std::max(std::abs(real), 1.0 / std::abs(through)));
    }
    const UncertaintyBlocks blocks{kReal, kScalar};
    const MuUpper upper = MuUpperBound(M, blocks);
    const double lower = MuLowerBound(M, blocks);
    EXPECT_GE(upper.value, 0.999 / smallest) << trial;  // step of the search
    EXPECT_LE(upper.value, 1.02 / smallest) << trial;   // two blocks: the bound is exact
    EXPECT_LE(lower, 1.001 / smallest) << trial;
    EXPECT_GE(lower, 0.9 / smallest) << trial;
    ExpectProven(M, upper);
  }
}

TEST(Mu, LowerBoundIsNotBelowThatOfTheComplexBlocksAlone) {
  // Real parameters at zero are allowed: what the complex block alone does is a bound.
  Random random(7);
  MatrixXcd M = 0.01 * DrawComplex(random, 6);
  M.bottomRightCorner(4, 4) *= 100.0;
  const UncertaintyBlocks blocks{kReal, kReal, {BlockKind::kFullComplex, 4, 4}};
  EXPECT_GE(MuLowerBound(M, blocks), 0.99 * LargestSingularValue(M.bottomRightCorner(4, 4)));
  EXPECT_LE(MuLowerBound(M, blocks), MuUpperBound(M, blocks).value * (1.0 + 1e-9));
}

TEST(Mu, OfRealBlocksIsNotAboveThatOfComplexOnes) {
  Random random(6);
  for (int trial = 0; trial < 5; ++trial) {
    const MatrixXcd M = DrawComplex(random, 6);
    const UncertaintyBlocks blocks{
        {BlockKind::kRepeatedReal, 2, 2}, kReal, kReal, {BlockKind::kFullComplex, 2, 2}};
    const double mixed = MuUpperBound(M, blocks).value;
    const double complex = MuUpperBound(M, AsComplex(blocks)).value;
    const double realised = MuUpperBound(M, blocks, true).value;
    EXPECT_LE(mixed, complex * 1.002);
    EXPECT_LE(complex, realised * 1.002);
    EXPECT_LE(MuLowerBound(M, blocks), mixed * (1.0 + 1e-9));
    EXPECT_LE(realised, LargestSingularValue(M) * (1.0 + 1e-9));
  }
}

TEST(Mu, RefusesBlocksThatDoNotCoverTheMatrix) {
  const MatrixXcd M = MatrixXcd::Identity(3, 3);
  EXPECT_THROW(static_cast<void>(MuUpperBound(M, {kScalar, kScalar})), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(MuLowerBound(M, {{BlockKind::kRepeatedReal, 3, 2}})),
               std::invalid_argument);
}

}  // namespace
}  // namespace levitas::synthesis

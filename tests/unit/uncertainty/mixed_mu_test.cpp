// The bound with real perturbations against what they are known to do, and against the synthesis'
// bound, which is found by another method.
#include "design/uncertainty/mixed_mu.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <complex>

#include "common/random.hpp"
#include "design/synthesis/structured_singular_value.hpp"
#include "design/uncertainty/uncertain_plant.hpp"

namespace levitas::uncertainty {
namespace {

using Eigen::Index;
using Eigen::MatrixXcd;
using Complex = std::complex<double>;

MatrixXcd Drawn(Random& random, Index size) {
  MatrixXcd m(size, size);
  for (Complex& entry : m.reshaped()) entry = {random.Normal(), random.Normal()};
  return m;
}

/// Gain of the last rows from the last columns with real perturbations in place of the first.
double GainWith(const MatrixXcd& m, const Eigen::VectorXd& delta) {
  const Index p = delta.size();
  const Index rest = m.rows() - p;
  const MatrixXcd inside = MatrixXcd::Identity(p, p) - m.topLeftCorner(p, p) * delta.asDiagonal();
  const MatrixXcd with =
      m.bottomRightCorner(rest, rest) + m.bottomLeftCorner(rest, p) * delta.asDiagonal() *
                                            inside.partialPivLu().solve(m.topRightCorner(p, rest));
  return with.bdcSvd().singularValues()[0];
}

TEST(MixedMu, OfAnImaginaryLoopIsNothingWhereAComplexPerturbationWouldCloseIt) {
  MatrixXcd m = MatrixXcd::Zero(2, 2);
  m(0, 0) = Complex(0.0, 2.0);
  m(1, 1) = 0.1;
  EXPECT_NEAR(ComplexMu(m, 1), 2.0, 1e-9);
  EXPECT_LT(MixedMu(m, 1), 0.2);  // 1 - 2j delta is never 0 for a real delta
  m(0, 0) = 2.0;
  EXPECT_NEAR(MixedMu(m, 1), 2.0, 1e-9);
}

TEST(MixedMu, IsABoundThatNoDrawnPerturbationExceedsAndAtMostTheComplexOne) {
  Random random(20261126);
  for (int n = 0; n < 20; ++n) {
    const MatrixXcd m = Drawn(random, 8);
    const double bound = MixedMu(m, 5);
    EXPECT_LE(bound, ComplexMu(m, 5) * (1.0 + 1e-12));
    // mu < b means: all |delta| <= 1/b leave a gain below b.
    for (int draw = 0; draw < 300; ++draw) {
      Eigen::VectorXd delta(5);
      for (double& value : delta) {
        const double place = 2.0 * random.Uniform() - 1.0;
        value = (draw % 2 == 0 ? place : (place < 0.0 ? -1.0 : 1.0)) / bound;
      }
      ASSERT_LE(GainWith(m, delta), bound * (1.0 + 1e-9)) << n;
    }
  }
}

TEST(MixedMu, IsTheSynthesisBoundToThreePerCent) {
  Random random(7);
  double complex_above = 0.0;
  for (int n = 0; n < 10; ++n) {
    const MatrixXcd m = Drawn(random, 7);
    synthesis::UncertaintyBlocks blocks(
        4, {.kind = synthesis::BlockKind::kRepeatedReal, .rows = 1, .columns = 1});
    blocks.push_back({.kind = synthesis::BlockKind::kFullComplex, .rows = 3, .columns = 3});
    const double other = synthesis::MuUpperBound(m, blocks).value;
    EXPECT_NEAR(MixedMu(m, 4), other, 0.03 * other) << n;
    complex_above = std::max(complex_above, ComplexMu(m, 4) / other);
  }
  EXPECT_GT(complex_above, 1.05);  // so that the two really differ
}

TEST(MixedMu, EndsWhereItIsGoodEnough) {
  Random random(3);
  const MatrixXcd m = Drawn(random, 8);
  const double complex = ComplexMu(m, 5);
  EXPECT_EQ(MixedMu(m, 5, 2.0 * complex), complex);
}

}  // namespace
}  // namespace levitas::uncertainty

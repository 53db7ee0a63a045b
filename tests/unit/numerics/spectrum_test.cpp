#include "numerics/dense/spectrum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/random.hpp"

namespace levitas::numerics {
namespace {

Eigen::MatrixXd Drawn(Eigen::Index size, levitas::Random& random) {
  Eigen::MatrixXd a(size, size);
  for (Eigen::Index i = 0; i < a.size(); ++i) a(i) = random.Normal();
  return a;
}

TEST(Spectrum, SumsToTheTraceAndItsVectorsAreHeld) {
  levitas::Random random(2);
  for (const Eigen::Index size : {1, 2, 7, 40}) {
    const Eigen::MatrixXd a = Drawn(size, random);
    const Spectrum spectrum = SpectrumOf(a);
    EXPECT_NEAR(std::abs(spectrum.values.sum() - a.trace()), 0.0, 1e-10);
    EXPECT_NEAR(std::abs(spectrum.values.array().square().sum() - (a * a).trace()), 0.0, 1e-8);
    const Eigen::MatrixXcd left =
        a * spectrum.vectors - spectrum.vectors * spectrum.values.asDiagonal();
    EXPECT_LT(left.norm(), 1e-10);
    EXPECT_EQ((EigenvaluesOf(a) - spectrum.values).norm(), 0.0);
  }
}

TEST(Spectrum, OfWhatHoldsNoNumberHoldsNone) {
  Eigen::MatrixXd a = Eigen::MatrixXd::Identity(3, 3);
  a(1, 2) = std::numeric_limits<double>::quiet_NaN();
  const Spectrum spectrum = SpectrumOf(a);
  ASSERT_EQ(spectrum.values.size(), 3);
  for (const auto& value : spectrum.values) EXPECT_TRUE(std::isnan(value.real()));
  EXPECT_EQ(EigenvaluesOf(Eigen::MatrixXd(0, 0)).size(), 0);
}

}  // namespace
}  // namespace levitas::numerics

#include "analysis/whirl_direction.hpp"

#include <gtest/gtest.h>

namespace levitas::analysis {
namespace {

const std::complex<double> kQuarter{0.0, 1.0};  // a quarter of a turn ahead

// A motion x = a cos(wt), y = b sin(wt) has the complex amplitudes a and -j b: of its two circles
// the forward one has the radius (a + b)/2, the backward one (a - b)/2.
TEST(ForwardShare, OfAnEllipseIsThatOfTheSquaresOfItsTwoCircles) {
  const auto of_ellipse = [](double a, double b) {
    Eigen::VectorXcd vector(2);
    vector << a, -kQuarter * b;
    return ForwardShare(vector, 1);
  };
  EXPECT_EQ(of_ellipse(2.0, 2.0), 1.0);
  EXPECT_EQ(of_ellipse(2.0, -2.0), 0.0);
  EXPECT_EQ(of_ellipse(2.0, 0.0), 0.5) << "a line";
  EXPECT_DOUBLE_EQ(of_ellipse(3.0, 1.0), 16.0 / 20.0);
  EXPECT_DOUBLE_EQ(of_ellipse(1.0, -3.0), 4.0 / 20.0);
}

TEST(ForwardShare, WeighsTheModesByTheirSquaresAndSeesNoneBehindThem) {
  // x of two modes, y of two modes, then a coordinate of something else (a twist).
  Eigen::VectorXcd vector(5);
  vector << 1.0, 2.0, -kQuarter, 2.0 * kQuarter, 100.0;
  EXPECT_DOUBLE_EQ(ForwardShare(vector, 2), 1.0 / 5.0) << "1 forward, 2 backward";
  vector *= 1e-9 * std::polar(1.0, 0.7);
  EXPECT_NEAR(ForwardShare(vector, 2), 1.0 / 5.0, 1e-12) << "an eigenvector has no scale or phase";
}

TEST(ForwardShare, OfNoMotionCountsAsALine) {
  EXPECT_EQ(ForwardShare(Eigen::VectorXcd::Zero(4), 2), 0.5);
}

}  // namespace
}  // namespace levitas::analysis

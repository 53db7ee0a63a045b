#include "identification/frf/synchronous.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace levitas::identification {
namespace {

/// 1000 samples of a rotor that turns 0.0314 rad a sample.
std::vector<double> Angles() {
  std::vector<double> angles;
  angles.reserve(1000);
  for (int n = 0; n < 1000; ++n) angles.push_back(std::fmod(0.0314 * n, 2.0 * 3.141592653589793));
  return angles;
}

TEST(Synchronous, RemovesOrdersAndMeanToTheLastDigits) {
  const std::vector<double> angle = Angles();
  std::vector<double> signal;
  signal.reserve(angle.size());
  for (const double a : angle) signal.push_back(3.0 + 2.0 * std::cos(a) - std::sin(3.0 * a));
  for (const double rest : WithoutSynchronous(signal, angle, 3)) {
    EXPECT_NEAR(rest, 0.0, 1e-10);  // rounding of 1000 additions in the normal equations
  }
}

TEST(Synchronous, LeavesWhatDoesNotTurnWithTheRotor) {
  const std::vector<double> angle = Angles();
  std::vector<double> signal;
  signal.reserve(angle.size());
  for (std::size_t n = 0; n < angle.size(); ++n) {
    signal.push_back(std::cos(0.5 * static_cast<double>(n)));
  }
  const std::vector<double> rest = WithoutSynchronous(signal, angle, 2);
  double error = 0.0;
  for (std::size_t n = 0; n < rest.size(); ++n) error += std::pow(rest[n] - signal[n], 2);
  // Five fitted functions take about 5 / 1000 of a signal they are not correlated with.
  EXPECT_LT(error / 500.0, 0.01);
}

TEST(Synchronous, OfOrderZeroIsTheMeanAlone) {
  const std::vector<double> rest =
      WithoutSynchronous(std::vector<double>{1.0, 2.0, 6.0}, std::vector<double>{0.0, 0.0, 0.0}, 0);
  EXPECT_NEAR(rest[0], -2.0, 1e-12);  // rounding
  EXPECT_NEAR(rest[2], 3.0, 1e-12);
}

}  // namespace
}  // namespace levitas::identification

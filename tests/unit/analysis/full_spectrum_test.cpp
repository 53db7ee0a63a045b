// Full spectrum of orbits whose forward and backward parts are known.

#include "analysis/full_spectrum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "common/random.hpp"

namespace levitas::analysis {
namespace {

using Complex = std::complex<double>;

constexpr std::size_t kSamples = 1000;
constexpr std::size_t kLines = 100;

/// forward e^(j 2 pi k n/N) + backward e^(-j 2 pi k n/N), k turns in the whole orbit.
std::vector<Complex> Orbit(double turns, Complex forward, Complex backward) {
  std::vector<Complex> orbit;
  for (std::size_t n = 0; n < kSamples; ++n) {
    const Complex heading =
        std::polar(1.0, 2.0 * std::numbers::pi * turns * static_cast<double>(n) / double{kSamples});
    orbit.push_back(forward * heading + backward * std::conj(heading));
  }
  return orbit;
}

/// Amplitude at a signed line; negative is backward.
double At(const std::vector<double>& amplitudes, int line) {
  return amplitudes.at(static_cast<std::size_t>(static_cast<int>(amplitudes.size() / 2) + line));
}

TEST(FullSpectrum, OfACircleIsOneLineOfItsRadiusOnTheSideOfItsWhirl) {
  const auto forward = FullAmplitudes(Orbit(20.0, {3e-6, 0.0}, 0.0), kLines);
  ASSERT_EQ(forward.size(), 2 * kLines + 1);
  EXPECT_NEAR(At(forward, 20), 3e-6, 1e-18);
  EXPECT_LT(At(forward, -20), 1e-18);
  const auto backward = FullAmplitudes(Orbit(20.0, 0.0, {3e-6, 0.0}), kLines);
  EXPECT_NEAR(At(backward, -20), 3e-6, 1e-18);
  EXPECT_LT(At(backward, 20), 1e-18);
}

TEST(FullSpectrum, OfAnEllipseHasHalfTheSumAndHalfTheDifferenceOfItsHalfAxes) {
  // x = a cos, y = b sin: (a + b)/2 forward, (a - b)/2 backward.
  constexpr double kA = 5e-6;
  constexpr double kB = 2e-6;
  std::vector<Complex> orbit;
  for (std::size_t n = 0; n < kSamples; ++n) {
    const double angle = 2.0 * std::numbers::pi * 10.0 * static_cast<double>(n) / double{kSamples};
    orbit.emplace_back(kA * std::cos(angle), kB * std::sin(angle));
  }
  const auto amplitudes = FullAmplitudes(orbit, kLines);
  EXPECT_NEAR(At(amplitudes, 10), 0.5 * (kA + kB), 1e-18);
  EXPECT_NEAR(At(amplitudes, -10), 0.5 * (kA - kB), 1e-18);
}

TEST(FullSpectrum, OfAStraightOrbitIsAsHighOnBothSides) {
  const auto amplitudes = FullAmplitudes(Orbit(7.0, {1e-6, 1e-6}, {1e-6, 1e-6}), kLines);
  EXPECT_NEAR(At(amplitudes, 7), At(amplitudes, -7), 1e-18);
}

TEST(FullSpectrum, DoesNotKnowWhereTheOrbitStands) {
  std::vector<Complex> orbit = Orbit(20.0, {3e-6, 1e-6}, {1e-6, 0.0});
  const auto centred = FullAmplitudes(orbit, kLines);
  for (Complex& value : orbit) value += Complex(40e-6, -15e-6);
  const auto beside = FullAmplitudes(orbit, kLines);
  // Rounding of the mean, 40e-6 x 1e-16 a sample.
  for (std::size_t k = 0; k < centred.size(); ++k) EXPECT_NEAR(beside[k], centred[k], 1e-18);
}

TEST(FullSpectrum, SpreadsALineOverItsTwoNeighboursByHalf) {
  // The Hann window's transform is 1/2, 1, 1/2 about a line.
  const auto amplitudes = FullAmplitudes(Orbit(20.0, {1e-6, 0.0}, 0.0), kLines);
  EXPECT_NEAR(At(amplitudes, 19), 0.5e-6, 1e-18);
  EXPECT_NEAR(At(amplitudes, 21), 0.5e-6, 1e-18);
  EXPECT_LT(At(amplitudes, 22), 1e-18);
}

TEST(FullSpectrum, LosesAtMostASeventhBetweenTwoLines) {
  // Scalloping of the Hann window: 1.42 dB.
  const auto amplitudes = FullAmplitudes(Orbit(20.5, {1e-6, 0.0}, 0.0), kLines);
  EXPECT_NEAR(At(amplitudes, 20) / 1e-6, std::pow(10.0, -1.42 / 20.0), 1e-3);
}

TEST(FullSpectrum, MirroredInTheXAxisExchangesForwardAndBackward) {
  Random random(5);
  std::vector<Complex> orbit;
  for (std::size_t n = 0; n < kSamples; ++n) orbit.emplace_back(random.Normal(), random.Normal());
  const auto one = FullAmplitudes(orbit, kLines);
  for (Complex& value : orbit) value = std::conj(value);
  const auto other = FullAmplitudes(orbit, kLines);
  for (int line = -static_cast<int>(kLines); line <= static_cast<int>(kLines); ++line) {
    EXPECT_NEAR(At(one, line), At(other, -line), 1e-12) << line;
  }
}

TEST(FullSpectrum, HasNoMoreLinesThanTheOrbitHolds) {
  const std::vector<Complex> orbit(16, Complex(1e-6, 0.0));
  EXPECT_EQ(FullAmplitudes(orbit, 100).size(), 15U);
  EXPECT_EQ(FullAmplitudes(orbit, 3).size(), 7U);
}

}  // namespace
}  // namespace levitas::analysis

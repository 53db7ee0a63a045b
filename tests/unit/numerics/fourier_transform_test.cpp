// The Fourier transform against its definition and its theorems, at lengths of every kind.

#include "numerics/fourier_transform.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "numerics/hann_window.hpp"

namespace levitas::numerics {
namespace {

using Complex = std::complex<double>;

constexpr double kTwoPi = 2.0 * std::numbers::pi;

std::vector<Complex> Random(std::size_t count, std::uint64_t seed) {
  std::mt19937_64 draw{seed};
  std::normal_distribution<double> normal;
  std::vector<Complex> values(count);
  for (Complex& value : values) value = {normal(draw), normal(draw)};
  return values;
}

Complex Defined(const std::vector<Complex>& x, std::size_t k) {
  Complex sum;
  for (std::size_t n = 0; n < x.size(); ++n) {
    const auto turns = static_cast<double>(k * n % x.size()) / static_cast<double>(x.size());
    sum += x[n] * std::polar(1.0, -kTwoPi * turns);
  }
  return sum;
}

/// Rounding of sums of some hundred numbers of size one, which both sides of a comparison make.
constexpr double kRounding = 1e-12;

TEST(FourierTransform, IsItsDefinitionAtEveryLengthUpTo70) {
  for (std::size_t length = 1; length <= 70; ++length) {
    const auto x = Random(length, length);
    auto lines = x;
    FourierTransform(lines);
    ASSERT_EQ(lines.size(), length);
    for (std::size_t k = 0; k < length; ++k) {
      EXPECT_LT(std::abs(lines[k] - Defined(x, k)), kRounding) << length << " values, line " << k;
    }
  }
}

TEST(FourierTransform, IsItsDefinitionAtLengthsWithALongPrime) {
  for (const std::size_t length : {131U, 262U, 393U, 509U, 1018U, 1031U}) {
    const auto x = Random(length, length);
    auto lines = x;
    FourierTransform(lines);
    ASSERT_EQ(lines.size(), length);
    for (std::size_t k = 0; k < length; ++k) {
      // Three transforms of twice the length and more: ten times the rounding of one.
      EXPECT_LT(std::abs(lines[k] - Defined(x, k)), 10.0 * kRounding) << length << ", " << k;
    }
  }
}

// A period of 2^13 - 1 bits of two samples: by its factors it would be 8191 squared.
TEST(HalfSpectrum, OfAPeriodOfAPrimeNumberOfBitsHasItsLine) {
  constexpr std::size_t kLength = std::size_t{2} * 8191;
  constexpr std::size_t kLine = 1234;
  std::vector<double> sine(kLength);
  for (std::size_t n = 0; n < kLength; ++n) {
    const auto turns = static_cast<double>(kLine * n % kLength) / static_cast<double>(kLength);
    sine[n] = std::cos(kTwoPi * turns);
  }
  const auto lines = HalfSpectrum(sine);
  ASSERT_EQ(lines.size(), kLength / 2 + 1);
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const double expected = k == kLine ? 0.5 * static_cast<double>(kLength) : 0.0;
    ASSERT_NEAR(std::abs(lines[k]), expected, 1e-9) << k;  // rounding of 16382 of size one
  }
}

TEST(FourierTransform, KeepsTheEnergyOfASignal) {  // Parseval
  for (const std::size_t length : {1000U, 1024U, 2047U, 6000U}) {
    auto values = Random(length, 7);
    double before = 0.0;
    for (const Complex& value : values) before += std::norm(value);
    FourierTransform(values);
    double after = 0.0;
    for (const Complex& line : values) after += std::norm(line);
    EXPECT_NEAR(after / (before * static_cast<double>(length)), 1.0, kRounding);
  }
}

TEST(FourierTransform, OfAnImpulseIsFlatAndOfNothingIsNothing) {
  std::vector<Complex> impulse(12);
  impulse[0] = 1.0;
  FourierTransform(impulse);
  for (const Complex& line : impulse) EXPECT_LT(std::abs(line - 1.0), kRounding);
  std::vector<Complex> none;
  FourierTransform(none);
  EXPECT_TRUE(none.empty());
}

TEST(HalfSpectrum, IsTheFirstHalfOfTheWholeOne) {
  for (const std::size_t length : {1U, 2U, 3U, 4U, 7U, 30U, 64U, 1000U, 1001U}) {
    std::vector<double> signal(length);
    const auto noise = Random(length, 5);
    std::vector<Complex> whole(length);
    for (std::size_t n = 0; n < length; ++n) whole[n] = signal[n] = noise[n].real();
    const auto half = HalfSpectrum(signal);
    FourierTransform(whole);
    ASSERT_EQ(half.size(), length / 2 + 1);
    for (std::size_t k = 0; k < std::min(half.size(), length); ++k) {
      EXPECT_LT(std::abs(half[k] - whole[k]), kRounding) << length << " values, line " << k;
    }
  }
  EXPECT_TRUE(HalfSpectrum({}).empty());
}

TEST(HannWeight, HasTheMeansOfTheWindowAndNoGapWhereCopiesOverlap) {
  for (const std::size_t length : {8U, 1000U, 1024U}) {
    double sum = 0.0;
    double squares = 0.0;
    for (std::size_t n = 0; n < length; ++n) {
      const double weight = HannWeight(n, length);
      sum += weight;
      squares += weight * weight;
      EXPECT_NEAR(weight + HannWeight((n + length / 2) % length, length), 1.0, kRounding);
    }
    EXPECT_NEAR(sum / static_cast<double>(length), 0.5, kRounding);
    EXPECT_NEAR(squares / static_cast<double>(length), 3.0 / 8.0, kRounding);
  }
}

TEST(HalfSpectrum, OfASineStandsOnItsLineWithItsPhase) {
  std::vector<double> signal(500);
  for (std::size_t n = 0; n < signal.size(); ++n) {
    signal[n] = 3.0 * std::cos(kTwoPi * 20.0 * static_cast<double>(n) / 500.0 + 0.4);
  }
  const auto lines = HalfSpectrum(signal);
  EXPECT_LT(std::abs(lines[20] - std::polar(0.5 * 3.0 * 500.0, 0.4)), 750.0 * kRounding);
  EXPECT_LT(std::abs(lines[21]), 750.0 * kRounding);
}

}  // namespace
}  // namespace levitas::numerics

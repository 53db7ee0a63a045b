#include "plant_sim/effect/reading.hpp"

#include <gtest/gtest.h>

namespace levitas::effect {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(Characteristic, OfACosineHasTheHarmonicsOfItsPowers) {
  // y = A cos t: a2 A^2/2 (1 + cos 2t) + a3 A^3/4 (3 cos t + cos 3t).
  constexpr double kA = 1e-4;
  constexpr double kA2 = 500.0;
  constexpr double kA3 = 5e6;
  for (double t = 0.0; t < 6.3; t += 0.1) {
    const double expected = kA * std::cos(t) + kA2 * kA * kA / 2.0 * (1.0 + std::cos(2.0 * t)) +
                            kA3 * kA * kA * kA / 4.0 * (3.0 * std::cos(t) + std::cos(3.0 * t));
    EXPECT_NEAR(Characteristic(kA * std::cos(t), kA2, kA3), expected, 1e-18);
  }
}

TEST(Characteristic, WithoutCoefficientsIsTheMotionBitForBit) {
  EXPECT_EQ(Characteristic(0.1e-3, 0.0, 0.0), 0.1e-3);
}

TEST(Turned, IsThePowerOfTheDirectionForwardAndBackward) {
  for (const int order : {-5, -2, -1, 0, 1, 2, 3, 7}) {
    const double angle = 0.7;
    const auto turned = Turned(std::cos(angle), std::sin(angle), order);
    EXPECT_NEAR(turned.real(), std::cos(order * angle), 1e-15 * 8);
    EXPECT_NEAR(turned.imag(), std::sin(order * angle), 1e-15 * 8);
  }
}

TEST(Runout, OfOneLobeTurnsForwardAndOfThreeLobesBackward) {
  const auto orbit = [](int order, double angle) {
    const auto turned = Turned(std::cos(angle), std::sin(angle), order);
    return std::complex<double>((RunoutAmplitude(1.0, 0.3, order, false) * turned).real(),
                                (RunoutAmplitude(1.0, 0.3, order, true) * turned).real());
  };
  for (double angle = 0.0; angle < 6.3; angle += 0.2) {
    // Two probes at 90 degrees on a surface of n lobes: cos(n(angle - probe) + phase).
    const auto once = orbit(1, angle) - std::polar(1.0, angle + 0.3);
    const auto thrice = orbit(3, angle) - std::polar(1.0, -(3.0 * angle + 0.3));
    EXPECT_LT(std::abs(once), 1e-14);
    EXPECT_LT(std::abs(thrice), 1e-14);
    // Two lobes move both probes against each other along one line.
    EXPECT_NEAR(orbit(2, angle).real(), -orbit(2, angle).imag(), 1e-14);
  }
}

TEST(NoiseMemory, KeepsThePowerAndIsNoneForWhiteNoise) {
  EXPECT_EQ(NoiseMemory(0.0, 1e-4), 0.0);
  // One pole at 2 pi f: after one time constant of samples 1/e is left.
  const double corner_hz = 1.0 / (2.0 * kPi * 20e-4);
  EXPECT_NEAR(std::pow(NoiseMemory(corner_hz, 1e-4), 20.0), std::exp(-1.0), 1e-14);
}

}  // namespace
}  // namespace levitas::effect

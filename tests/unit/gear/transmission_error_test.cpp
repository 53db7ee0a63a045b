#include "plant_sim/gear/transmission_error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <random>

namespace levitas::gear {
namespace {

using Complex = std::complex<double>;

constexpr Complex kJ{0.0, 1.0};
// Sums of a dozen terms of 10 um: rounding stays below 1e-19 m.
constexpr double kRounding = 1e-18;

// The series as it is written, term by term.
Complex Series(const std::vector<Harmonic>& harmonics, double angle_rad, double rate) {
  Complex sum;
  for (const Harmonic& h : harmonics) {
    const Complex term = h.amplitude_m * std::exp(kJ * (h.order * angle_rad + h.phase_rad));
    sum += rate == 0.0 ? term : kJ * static_cast<double>(h.order) * rate * term;
  }
  return sum;
}

Vector Unit(double angle_rad) { return {std::cos(angle_rad), std::sin(angle_rad)}; }

TEST(TransmissionError, IsTheComplexSeriesAndItsDerivative) {
  std::mt19937_64 draw{20261121};
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  for (int round = 0; round < 200; ++round) {
    std::vector<Harmonic> harmonics;
    for (int order = -5; order <= 5; ++order) {
      harmonics.push_back({order, 1e-5 * std::abs(number(draw)), 3.0 * number(draw)});
    }
    const double angle_rad = 10.0 * number(draw);
    const double rate = 3000.0 * number(draw);
    const Prescribed e = TransmissionError(harmonics).At(Unit(angle_rad), rate);
    const Complex value = Series(harmonics, angle_rad, 0.0);
    const Complex slope = Series(harmonics, angle_rad, rate);
    EXPECT_NEAR(e.displacement_m.x, value.real(), kRounding);
    EXPECT_NEAR(e.displacement_m.y, value.imag(), kRounding);
    EXPECT_NEAR(e.rate_m_per_s.x, slope.real(), 2e4 * kRounding);  // times 5 orders x 3000 rad/s
    EXPECT_NEAR(e.rate_m_per_s.y, slope.imag(), 2e4 * kRounding);
  }
}

TEST(TransmissionError, IsNothingWithoutHarmonics) {
  const Prescribed e = TransmissionError(std::vector<Harmonic>{}).At(Unit(1.0), 100.0);
  EXPECT_EQ(e.displacement_m.x, 0.0);
  EXPECT_EQ(e.rate_m_per_s.y, 0.0);
}

TEST(TransmissionError, AddsHarmonicsOfOneOrder) {
  const TransmissionError once({{2, 3e-6, 0.4}});
  const TransmissionError twice({{2, 1e-6, 0.4}, {2, 2e-6, 0.4}});
  EXPECT_NEAR(once.At(Unit(0.7), 1.0).displacement_m.x, twice.At(Unit(0.7), 1.0).displacement_m.x,
              kRounding);
}

TEST(TransmissionError, TurnsBackwardsForANegativeOrder) {
  const TransmissionError backward({{-1, 1e-6, 0.0}});
  const Vector at = backward.At(Unit(0.3), 1.0).displacement_m;
  EXPECT_NEAR(std::atan2(at.y, at.x), -0.3, 1e-12);  // of a double's angle
}

}  // namespace
}  // namespace levitas::gear

#include "controller/law/discrete_law.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "tests/unit/law/flexible_rotor_law.hpp"

namespace levitas::law {
namespace {

using Complex = std::complex<double>;

// Tustin's rule maps z = e^{jwT} to s = j (2/T) tan(wT/2) exactly, so the two responses agree to
// rounding; the largest number of digits is lost near Nyquist, where tan() is steep: 1e-12 holds
// up to 0.998 of it.
constexpr double kRounding = 1e-12;

void ExpectTustin(const AxisLawConfig& axis, double period_s) {
  const DiscreteLaw law = Discretise(axis, period_s);
  for (double share = 1e-4; share < 0.998; share *= 1.03) {
    const double frequency_hz = share * 0.5 / period_s;
    const Complex discrete = FrequencyResponse(law, frequency_hz, period_s);
    const Complex continuous =
        ContinuousResponse(axis, Complex(0.0, TustinWarp(frequency_hz, period_s)));
    ASSERT_LT(std::abs(discrete - continuous), kRounding * std::abs(continuous))
        << frequency_hz << " Hz";
  }
}

TEST(DiscreteLaw, EqualsTheContinuousLawAtTheWarpedFrequency) {
  ExpectTustin(FlexibleRotorAxis(), kPeriodS);
  ExpectTustin(FlexibleRotorAxis(2.1294), kPeriodS);
}

TEST(DiscreteLaw, HoldsForAnyNumberOfSectionsAndOtherPeriods) {
  AxisLawConfig axis = FlexibleRotorAxis();
  axis.notches.push_back({1200.0, 0.1, 0.6});
  axis.notches.push_back({90.0, 0.9, 0.4});
  axis.lead_lags.push_back({300.0, 2500.0});
  ExpectTustin(axis, 5e-5);
  axis.ki_a_per_m_s = 0.0;
  ExpectTustin(axis, kPeriodS);
  axis.kd_a_s_per_m = 0.0;
  axis.derivative_hz = 0.0;  // not used without derivative gain
  ExpectTustin(axis, kPeriodS);
}

// Where the zeros of a section lie on the unit circle [Hz]; without damping they lie on it.
double ZerosAt(const Section& s, double period_s) {
  return std::acos(-0.5 * s.b1 / s.b0) / (2.0 * std::numbers::pi * period_s);
}

TEST(Notch, WithPrewarpStandsAtTheFrequencyGiven) {
  for (const double frequency_hz : {10.0, 449.181, 1049.0, 2000.0, 4500.0}) {
    const Notch notch{frequency_hz, 0.0, 0.5, true};
    AxisLawConfig axis = FlexibleRotorAxis();
    axis.notches = {notch};
    const DiscreteLaw law = Discretise(axis, kPeriodS);
    // acos loses digits at low frequency, where the cosine is flat: 1e-9 holds from 10 Hz on.
    EXPECT_NEAR(ZerosAt(law.notches[0], kPeriodS) / frequency_hz, 1.0, 1e-9) << frequency_hz;
    EXPECT_EQ(StandsAt(notch, kPeriodS), frequency_hz);
  }
}

TEST(Notch, WithoutPrewarpStandsBelowAsTustinsRuleHasIt) {
  const Notch notch{1049.0, 0.0, 0.5};
  AxisLawConfig axis = FlexibleRotorAxis();
  axis.notches = {notch};
  const double stands_hz = ZerosAt(Discretise(axis, kPeriodS).notches[0], kPeriodS);
  EXPECT_NEAR(StandsAt(notch, kPeriodS) / stands_hz, 1.0, 1e-9);
  // tan(pi f T) = pi 1049 T: 1013.x Hz.
  EXPECT_NEAR(std::tan(std::numbers::pi * stands_hz * kPeriodS),
              std::numbers::pi * 1049.0 * kPeriodS, 1e-9);
  EXPECT_NEAR(StandsAt({2000.0, 0.0, 0.5}, kPeriodS), 1786.0, 1.0);
}

TEST(Notch, KeepsItsDampingUnderPrewarp) {
  // The substitution maps the frequency given onto itself: there N = zz/zp with and without zeros
  // on the circle.
  AxisLawConfig with = FlexibleRotorAxis();
  with.notches = {{1500.0, 0.2, 0.8, true}};
  AxisLawConfig without = with;
  without.notches.clear();
  const Complex ratio = FrequencyResponse(Discretise(with, kPeriodS), 1500.0, kPeriodS) /
                        FrequencyResponse(Discretise(without, kPeriodS), 1500.0, kPeriodS);
  EXPECT_LT(std::abs(ratio - 0.25), kRounding);
}

TEST(DiscreteLaw, NotchesPassZeroFrequencyAndNyquistUnchanged) {
  const DiscreteLaw law = Discretise(FlexibleRotorAxis(), kPeriodS);
  ASSERT_EQ(law.notches.size(), 2U);
  for (const Section& s : law.notches) {
    // s = 0 and s = infinity both give N = 1; a few rounding errors of numbers near 1.
    EXPECT_NEAR((s.b0 + s.b1 + s.b2) / (1.0 + s.a1 + s.a2), 1.0, 1e-13);
    EXPECT_NEAR((s.b0 - s.b1 + s.b2) / (1.0 - s.a1 + s.a2), 1.0, 1e-13);
  }
}

TEST(DiscreteLaw, TustinKeepsTheNotchDepthAtItsWarpedCentre) {
  const Notch notch{862.316, 0.2442, 0.8139};
  AxisLawConfig axis;
  axis.kp_a_per_m = 1.0;
  axis.notches = {notch};
  // N(j w0) = zz/zp, found at the frequency that warps to w0.
  const double centre_hz =
      std::atan(std::numbers::pi * notch.frequency_hz * kPeriodS) / (std::numbers::pi * kPeriodS);
  const Complex response = FrequencyResponse(Discretise(axis, kPeriodS), centre_hz, kPeriodS);
  EXPECT_NEAR(std::abs(response), notch.zero_damping / notch.pole_damping, 1e-12);
}

Complex CascadeResponse(const std::vector<Section>& sections, double frequency_hz) {
  const Complex q = std::polar(1.0, -2.0 * std::numbers::pi * frequency_hz * kPeriodS);
  Complex response = 1.0;
  for (const Section& s : sections) {
    response *= (s.b0 + s.b1 * q + s.b2 * q * q) / (1.0 + s.a1 * q + s.a2 * q * q);
  }
  return response;
}

TEST(DiscreteSections, AreTheSameLawAsACascade) {
  for (const bool integral : {true, false}) {
    for (const bool derivative : {true, false}) {
      AxisLawConfig axis = FlexibleRotorAxis();
      if (!integral) axis.ki_a_per_m_s = 0.0;
      if (!derivative) axis.kd_a_s_per_m = 0.0;
      const DiscreteLaw law = Discretise(axis, kPeriodS);
      for (double hz = 1.0; hz < 4990.0; hz *= 1.1) {
        const Complex parallel = FrequencyResponse(law, hz, kPeriodS);
        // The common denominator of the PID cancels three to four digits at 1 Hz.
        ASSERT_LT(std::abs(CascadeResponse(DiscreteSections(axis, kPeriodS), hz) - parallel),
                  1e-10 * std::abs(parallel))
            << hz;
      }
    }
  }
}

TEST(DiscreteSections, HaveNoIntegratorPoleWithoutIntegralGain) {
  AxisLawConfig axis = FlexibleRotorAxis();
  const Section with = DiscreteSections(axis, kPeriodS).front();
  EXPECT_NEAR(1.0 + with.a1 + with.a2, 0.0, 1e-15);  // denominator at z = 1
  axis.ki_a_per_m_s = 0.0;
  const Section without = DiscreteSections(axis, kPeriodS).front();
  EXPECT_GT(std::abs(1.0 + without.a1 + without.a2), 0.1);
  EXPECT_EQ(DiscreteSections(axis, kPeriodS).size(), 4U);  // PID, lead-lag, two notches
}

TEST(DiscreteLaw, RefusesWhatCannotBeDiscretised) {
  const auto refused = [](auto change, double period_s, const char* name) {
    AxisLawConfig axis = FlexibleRotorAxis();
    change(axis);
    try {
      (void)Discretise(axis, period_s);
    } catch (const std::invalid_argument& problem) {
      return std::string(problem.what()).find(name) != std::string::npos;
    }
    return false;
  };
  const auto same = [](AxisLawConfig&) {};
  EXPECT_TRUE(refused(same, 0.0, "period_s"));
  EXPECT_TRUE(refused(same, std::numeric_limits<double>::quiet_NaN(), "period_s"));
  EXPECT_TRUE(refused([](auto& a) { a.derivative_hz = 0.0; }, kPeriodS, "derivative_hz"));
  EXPECT_TRUE(refused([](auto& a) { a.lead_lags[0].pole_hz = -1.0; }, kPeriodS, "pole_hz"));
  EXPECT_TRUE(refused([](auto& a) { a.notches[1].pole_damping = 0.0; }, kPeriodS, "pole_damping"));
  EXPECT_TRUE(refused([](auto& a) { a.kp_a_per_m = HUGE_VAL; }, kPeriodS, "kp_a_per_m"));
}

}  // namespace
}  // namespace levitas::law

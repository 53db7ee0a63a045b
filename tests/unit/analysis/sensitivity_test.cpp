#include "analysis/sensitivity.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <tuple>

#include "analysis/poles.hpp"
#include "common/rotational_speed.hpp"
#include "controller/law/discrete_law.hpp"
#include "tests/support/test_rigs.hpp"
#include "tests/unit/analysis/laws.hpp"

namespace levitas::analysis {
namespace {

constexpr double kPi = std::numbers::pi;

void Scale(law::AxisLawConfig& axis, double factor) {
  axis.kp_a_per_m *= factor;
  axis.ki_a_per_m_s *= factor;
  axis.kd_a_s_per_m *= factor;
}

TEST(Zones, ChangeAtThreeFourAndFive) {
  EXPECT_EQ(ZoneOf(2.999), Zone::kA);
  EXPECT_EQ(ZoneOf(3.0), Zone::kB);
  EXPECT_EQ(ZoneOf(3.999), Zone::kB);
  EXPECT_EQ(ZoneOf(4.0), Zone::kC);
  EXPECT_EQ(ZoneOf(4.999), Zone::kC);
  EXPECT_EQ(ZoneOf(5.0), Zone::kD);
  EXPECT_EQ(Name(Zone::kA), "A");
  EXPECT_EQ(Name(Zone::kD), "D");
}

// Rigid cylinder, equal bearings: in x the two axes couple through translation and tilt. P has
// (p_t + p_r)/2-like entries with p = 2 ki / (M s^2 - 2 ks) for each motion, so that with the same
// C on both axes S_ii is the mean of the two motions' 1/(1 + p C).
TEST(Sensitivity, OfARigidRotorIsTheMeanOfItsTwoMotions) {
  const plant::PlantConfig plant = test::RigidCylinder();
  const law::LawConfig law = test::PdLaw(plant, 6000.0, 15.0, 1e5);
  const law::DiscreteLaw discrete = law::Discretise(law.axes[0], law.period_s);
  const double r = 0.5 * test::kCylinderDiameter;
  const double length = test::kCylinderLength;
  const double mass = kPi * r * r * length * test::kCylinderDensity;
  const double tilt =
      mass * (3.0 * r * r + length * length) / 12.0 / (test::kCylinderArm * test::kCylinderArm);
  const std::vector<double> frequencies_hz{1.0, 20.0, 60.0, 100.0, 200.0, 500.0, 2000.0};
  const auto rows = SensitivityAt(plant, law, 0.0, frequencies_hz);
  ASSERT_EQ(rows.size(), frequencies_hz.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::complex<double> s{0.0, 2.0 * kPi * frequencies_hz[i]};
    const double corner = 2.0 * kPi * 1e5;
    // Amplifier, sensor, delay of one sample and the hold's half.
    const std::complex<double> chain =
        std::exp(-1.5 * law.period_s * s) / ((1.0 + s / corner) * (1.0 + s / corner));
    const std::complex<double> c =
        law::FrequencyResponse(discrete, frequencies_hz[i], law.period_s) * chain;
    std::complex<double> mean{};
    for (const double inertia : {mass, tilt}) {
      const std::complex<double> p = 2.0 * 40.0 / (inertia * s * s - 2.0 * 40.0 / 0.381e-3);
      mean += 0.5 / (1.0 + p * c);
    }
    ASSERT_EQ(rows[i].size(), 4U);
    for (const double value : rows[i]) {
      // The hold is exact in the program and a half-sample delay here: (w T)^2/24 < 1e-5.
      EXPECT_NEAR(value, std::abs(mean), 1e-5 * std::abs(mean)) << frequencies_hz[i] << " Hz";
    }
  }
}

TEST(SensitivityPeaks, AreNotExceededAnywhereOnAGridOfTheirOwn) {
  const auto plant = test::QuietFlexibleRotor();
  const auto law = test::FlexibleRotorLaw();
  const double speed = RpmToRadPerS(3000.0);
  const SensitivityResult result = SensitivityPeaks(plant, law, speed);
  ASSERT_TRUE(result.stable);
  std::vector<double> frequencies_hz;
  for (double f = 1.0; f < 5000.0; f += 1.0) frequencies_hz.push_back(f);
  for (const auto& axis : result.axes) {
    for (double step = -0.5; step < 0.5; step += 0.05) {
      frequencies_hz.push_back(axis.frequency_hz + step);
    }
  }
  const auto rows = SensitivityAt(plant, law, speed, frequencies_hz);
  for (std::size_t axis = 0; axis < 4; ++axis) {
    double largest = 0.0;
    for (const auto& row : rows) largest = std::max(largest, row[axis]);
    // The peak is known to 1e-6 by construction.
    EXPECT_LE(largest, result.axes[axis].peak * (1.0 + 1e-6));
    EXPECT_GT(largest, result.axes[axis].peak * 0.99);
    EXPECT_LE(result.axes[axis].peak, result.largest_singular_value);
    EXPECT_EQ(result.axes[axis].zone, ZoneOf(result.axes[axis].peak));
  }
}

TEST(SensitivityPeaks, AreTheSameInBothPlanesOfAnIsotropicRotor) {
  const auto result = SensitivityPeaks(test::QuietFlexibleRotor(), test::FlexibleRotorLaw(), 0.0);
  // Identical equations, rounding only.
  EXPECT_NEAR(result.axes[0].peak, result.axes[1].peak, 1e-6);
  EXPECT_NEAR(result.axes[2].peak, result.axes[3].peak, 1e-6);
}

TEST(SensitivityPeaks, GiveNoGradeToAnUnstableLoopHoweverSmallItsPeak) {
  // A controller far too weak to lift the rotor hardly moves the sensitivity away from one.
  const auto plant = test::UfuRig();
  const SensitivityResult result =
      SensitivityPeaks(plant, test::PdLaw(plant, 20.0, 0.005, 2000.0), 0.0);
  EXPECT_FALSE(result.stable);
  EXPECT_GT(result.largest_pole_modulus, 1.0);
  EXPECT_FALSE(result.zone.has_value());
  for (const auto& axis : result.axes) {
    EXPECT_LT(axis.peak, 1.1) << "would be zone A";
    EXPECT_FALSE(axis.zone.has_value());
    EXPECT_FALSE(axis.margins.gain_up.has_value());
    EXPECT_FALSE(axis.margins.phase_rad.has_value());
  }
}

class GainMargins : public testing::TestWithParam<std::tuple<std::size_t, double>> {};

TEST_P(GainMargins, AreTheFactorsAtWhichTheLoopLosesItsStability) {
  const auto plant = test::QuietFlexibleRotor();
  const law::LawConfig law = test::FlexibleRotorLaw();
  const auto [axis, speed_rpm] = GetParam();
  const double speed = RpmToRadPerS(speed_rpm);
  const SensitivityResult result = SensitivityPeaks(plant, law, speed);
  ASSERT_TRUE(result.stable);
  const AxisMargins margins = result.axes[axis].margins;
  ASSERT_TRUE(margins.gain_up && margins.gain_down);
  const auto stable_at = [&, scaled = axis](double factor) {
    law::LawConfig changed = law;
    Scale(changed.axes[scaled], factor);
    return ClosedLoopPoles(plant, changed, speed).stable;
  };
  // 0.1 % either side of the edge: far more than the bisection's error.
  EXPECT_TRUE(stable_at(*margins.gain_up * 0.999));
  EXPECT_FALSE(stable_at(*margins.gain_up * 1.001));
  EXPECT_TRUE(stable_at(*margins.gain_down * 1.001));
  EXPECT_FALSE(stable_at(*margins.gain_down * 0.999));
  // And no edge lies nearer.
  for (int tenth = 1; tenth < 10; ++tenth) {
    const double share = 0.1 * tenth;
    EXPECT_TRUE(stable_at(1.0 + share * (*margins.gain_up - 1.0)));
    EXPECT_TRUE(stable_at(1.0 + share * (*margins.gain_down - 1.0)));
  }
}

INSTANTIATE_TEST_SUITE_P(FlexibleRotor, GainMargins,
                         testing::Combine(testing::Values(0U, 1U, 2U, 3U),
                                          testing::Values(0.0, 6000.0)));

// (ki Kp - ks) x = f: statically a PD loop is lost where ki Kp = ks, and nothing oscillates then.
TEST(GainMargin, TowardsLessGainCountsTheCrossingAtStandstillOfTheLoop) {
  const plant::PlantConfig plant = test::RigidCylinder();
  // Stiff and well damped: with less gain nothing is lost before the static stiffness is.
  const law::LawConfig law = test::PdLaw(plant, 6000.0, 15.0, 1e5);
  // Both axes of a plane share two motions, so one axis alone may lose less than both together:
  // translation and tilt have P = p_t/2 +- p_r/2 with p = 2 ki/(-2 ks) each at f = 0, hence
  // diagonal alone, and L(0) = -ki Kp/ks.
  const double lost = (40.0 / 0.381e-3) / (40.0 * 6000.0);
  const SensitivityResult result = SensitivityPeaks(plant, law, 0.0);
  ASSERT_TRUE(result.stable);
  for (std::size_t axis = 0; axis < 4; ++axis) {
    ASSERT_TRUE(result.axes[axis].margins.gain_down.has_value());
    // Rounding of P(1) only.
    EXPECT_NEAR(*result.axes[axis].margins.gain_down, lost, 1e-6);
    for (const double beside : {0.99, 1.01}) {
      law::LawConfig changed = law;
      Scale(changed.axes[axis], beside * lost);
      EXPECT_EQ(ClosedLoopPoles(plant, changed, 0.0).stable, beside > 1.0);
    }
  }
}

TEST(PhaseMargin, BoundsTheSensitivityFromBelow) {
  // At |L| = 1 the distance to -1 is 2 sin(margin/2), so that the peak is at least its inverse.
  const auto result = SensitivityPeaks(test::QuietFlexibleRotor(), test::FlexibleRotorLaw(), 0.0);
  for (const auto& axis : result.axes) {
    ASSERT_TRUE(axis.margins.phase_rad.has_value());
    EXPECT_GE(axis.peak * (1.0 + 1e-6), 0.5 / std::sin(0.5 * *axis.margins.phase_rad));
  }
}

}  // namespace
}  // namespace levitas::analysis

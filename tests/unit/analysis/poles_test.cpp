#include "analysis/poles.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/problem.hpp"
#include "common/rotational_speed.hpp"
#include "tests/support/reference_csv.hpp"
#include "tests/support/test_rigs.hpp"
#include "tests/unit/analysis/laws.hpp"

namespace levitas::analysis {
namespace {

constexpr double kHalfTurn = std::numbers::pi;

struct ReferencePole {
  double frequency_hz{};
  double damping_ratio{};
};

std::vector<ReferencePole> ReferencePoles(double speed_rpm) {
  std::vector<ReferencePole> poles;
  for (const auto& row : test::ReadReference("flexible_rotor_closed_loop.csv")) {
    if (row[0] == speed_rpm) poles.push_back({row[1], row[2]});
  }
  return poles;
}

/// Half a percent in frequency, 0.002 in damping ratio. Below 1 Hz the poles hardly oscillate and
/// the reference prints three decimals, so that 0.005 Hz stands in for the half percent.
bool Agree(const Pole& ours, const ReferencePole& theirs) {
  const double tolerance_hz = std::max(0.005, 0.005 * std::abs(theirs.frequency_hz));
  return std::abs(ours.frequency_hz - theirs.frequency_hz) <= tolerance_hz &&
         std::abs(ours.damping_ratio - theirs.damping_ratio) <= 0.002;
}

class ReferenceSpeeds : public testing::TestWithParam<double> {};

TEST_P(ReferenceSpeeds, HaveEveryPoleOfTheReferenceOnceAndNoOther) {
  const LoopPoles poles = ClosedLoopPoles(test::QuietFlexibleRotor(), test::FlexibleRotorLaw(),
                                          RpmToRadPerS(GetParam()));
  EXPECT_TRUE(poles.stable);
  std::vector<Pole> left;
  std::copy_if(poles.poles.begin(), poles.poles.end(), std::back_inserter(left),
               [](const Pole& pole) { return std::abs(pole.frequency_hz) < 1000.0; });
  const auto reference = ReferencePoles(GetParam());
  ASSERT_EQ(reference.size(), 28U);
  for (const ReferencePole& wanted : reference) {
    const auto found = std::find_if(left.begin(), left.end(),
                                    [&](const Pole& pole) { return Agree(pole, wanted); });
    if (found == left.end()) {
      ADD_FAILURE() << "no pole at " << wanted.frequency_hz << " Hz, " << wanted.damping_ratio;
    } else {
      left.erase(found);
    }
  }
  for (const Pole& pole : left) {
    ADD_FAILURE() << "not in the reference: " << pole.frequency_hz << " Hz, " << pole.damping_ratio;
  }
}

INSTANTIATE_TEST_SUITE_P(FlexibleRotor, ReferenceSpeeds,
                         testing::Values(0.0, 1600.0, 3000.0, 6000.0));

// Rigid cylinder: translation m x'' = 2 (ki ic + ks x); tilt the same with I/a^2 in place of m.
// With ic = -(Kp + Kd s) x each motion is M s^2 + 2 ki Kd s + 2 (ki Kp - ks) = 0.
struct Quadratic {
  double omega_rad_per_s{};
  double damping{};
};

Quadratic Motion(double inertia, double ki, double ks, double kp, double kd) {
  const double omega = std::sqrt(2.0 * (ki * kp - ks) / inertia);
  return {omega, 2.0 * ki * kd / inertia / (2.0 * omega)};
}

struct Cylinder {
  double mass_kg{};
  double tilt_mass_kg{};   ///< diametral inertia over arm squared
  double polar_mass_kg{};  ///< polar inertia over arm squared
};

Cylinder CylinderMasses() {
  const double r = 0.5 * test::kCylinderDiameter;
  const double length = test::kCylinderLength;
  const double mass = kHalfTurn * r * r * length * test::kCylinderDensity;
  const double arm2 = test::kCylinderArm * test::kCylinderArm;
  return {mass, mass * (3.0 * r * r + length * length) / 12.0 / arm2, 0.5 * mass * r * r / arm2};
}

constexpr double kKi = 40.0;
constexpr double kKs = 40.0 / 0.381e-3;
constexpr double kKp = 6000.0;
constexpr double kKd = 8.0;

TEST(ClosedLoopPoles, OfARigidRotorUnderPdTendToTheQuadraticAsThePeriodVanishes) {
  const plant::PlantConfig plant = test::RigidCylinder();
  const LoopPoles poles = ClosedLoopPoles(plant, test::PdLaw(plant, kKp, kKd, 1e5), 0.0);
  EXPECT_TRUE(poles.stable);
  const Cylinder cylinder = CylinderMasses();
  for (const double inertia : {cylinder.mass_kg, cylinder.tilt_mass_kg}) {
    const Quadratic expected = Motion(inertia, kKi, kKs, kKp, kKd);
    ASSERT_LT(expected.damping, 1.0);
    const double damped_hz = expected.omega_rad_per_s *
                             std::sqrt(1.0 - expected.damping * expected.damping) / 2.0 / kHalfTurn;
    int forward = 0;
    int backward = 0;
    for (const Pole& pole : poles.poles) {
      // Amplifier, sensor, derivative filter (100 kHz each) and delay (1.5 us) lag by 6 us in all:
      // 0.3 % of the motion's own time scale of about 2 ms, felt up to three times in the damping.
      if (std::abs(std::abs(pole.frequency_hz) - damped_hz) > 0.01 * damped_hz) continue;
      EXPECT_NEAR(pole.damping_ratio, expected.damping, 0.01 * expected.damping);
      (pole.frequency_hz > 0.0 ? forward : backward) += 1;
    }
    EXPECT_EQ(forward, 1) << damped_hz << " Hz";
    EXPECT_EQ(backward, 1) << damped_hz << " Hz";
  }
}

TEST(ClosedLoopPoles, OfATurningCylinderSplitByItsPolarInertiaInTheRightDirections) {
  // Complex tilt: I s^2 - j W Ip s + d s + k = 0; without damping the forward root is the faster.
  const plant::PlantConfig plant = test::RigidCylinder();
  const double speed = 2000.0;
  const LoopPoles poles = ClosedLoopPoles(plant, test::PdLaw(plant, kKp, 0.5, 1e5), speed);
  const Cylinder cylinder = CylinderMasses();
  const std::complex<double> damping{2.0 * kKi * 0.5, -speed * cylinder.polar_mass_kg};
  const double stiffness = 2.0 * (kKi * kKp - kKs);
  const std::complex<double> root =
      std::sqrt(damping * damping - 4.0 * cylinder.tilt_mass_kg * stiffness);
  for (const double sign : {1.0, -1.0}) {
    const std::complex<double> s = (-damping + sign * root) / (2.0 * cylinder.tilt_mass_kg);
    const double expected_hz = s.imag() / 2.0 / kHalfTurn;
    // The same 6 us of lag: it takes damping and adds well under 0.5 % of frequency.
    EXPECT_TRUE(std::any_of(poles.poles.begin(), poles.poles.end(),
                            [&](const Pole& pole) {
                              return std::abs(pole.frequency_hz - expected_hz) <
                                     0.005 * std::abs(expected_hz);
                            }))
        << expected_hz << " Hz";
  }
}

TEST(ClosedLoopPoles, SayUnstableWhenTheGainIsBelowTheMagnetsOwnStiffness) {
  const plant::PlantConfig plant = test::RigidCylinder();
  const double edge = kKs / kKi;  // ki Kp = ks
  EXPECT_TRUE(ClosedLoopPoles(plant, test::PdLaw(plant, 1.1 * edge, kKd, 1e5), 0.0).stable);
  const LoopPoles below = ClosedLoopPoles(plant, test::PdLaw(plant, 0.9 * edge, kKd, 1e5), 0.0);
  EXPECT_FALSE(below.stable);
  EXPECT_GT(below.largest_pole_modulus, 1.0);
}

TEST(ClosedLoopPoles, TellASampledLoopUnstableThatContinuousTimeCallsStable) {
  // The same PD at 1 us and at 2 ms period: only the delay tells them apart.
  plant::PlantConfig plant = test::RigidCylinder();
  EXPECT_TRUE(ClosedLoopPoles(plant, test::PdLaw(plant, kKp, kKd, 1e5), 0.0).stable);
  plant.period_ns = 2'000'000;
  EXPECT_FALSE(ClosedLoopPoles(plant, test::PdLaw(plant, kKp, kKd, 1e5), 0.0).stable);
}

TEST(ClosedLoopPoles, RefuseALawWithAnotherNumberOfAxes) {
  law::LawConfig law = test::FlexibleRotorLaw();
  law.axes.pop_back();
  try {
    static_cast<void>(ClosedLoopPoles(test::QuietFlexibleRotor(), law, 0.0));
    FAIL() << "accepted three axes for two bearings";
  } catch (const BadInput& problem) {
    EXPECT_THAT(problem.what(), testing::HasSubstr("the controller has 3 axes, the rig has 4"));
  }
}

TEST(ClosedLoopPoles, AreConjugateUnderReversalOfTheRotation) {
  const auto plant = test::QuietFlexibleRotor();
  const auto law = test::FlexibleRotorLaw();
  const LoopPoles ahead = ClosedLoopPoles(plant, law, RpmToRadPerS(3000.0));
  const LoopPoles astern = ClosedLoopPoles(plant, law, RpmToRadPerS(-3000.0));
  ASSERT_EQ(ahead.poles.size(), astern.poles.size());
  for (const Pole& pole : ahead.poles) {
    if (std::abs(pole.frequency_hz) < 1.0 || std::abs(pole.frequency_hz) > 1000.0) continue;
    // 1e-4 Hz: what the eigenvalue solver leaves of 200 Hz at this size.
    EXPECT_TRUE(std::any_of(astern.poles.begin(), astern.poles.end(), [&](const Pole& other) {
      return std::abs(other.frequency_hz + pole.frequency_hz) < 1e-4 &&
             std::abs(other.damping_ratio - pole.damping_ratio) < 1e-6;
    })) << pole.frequency_hz;
  }
}

TEST(WorstFirst, ListsWhatGrowsBeforeWhatIsHardlyDampedWhateverItsFrequency) {
  const auto pole = [](double modulus, double damping) {
    Pole one;
    one.z = std::polar(modulus, 0.1);
    one.damping_ratio = damping;
    return one;
  };
  const auto sorted = WorstFirst(
      {pole(0.9, 0.5), pole(1.01, -0.3), pole(0.999, 0.01), pole(1.2, -0.1), pole(1.0, 0.0)});
  std::vector<double> dampings;
  dampings.reserve(sorted.size());
  for (const Pole& one : sorted) dampings.push_back(one.damping_ratio);
  EXPECT_THAT(dampings, testing::ElementsAre(-0.1, -0.3, 0.0, 0.01, 0.5));
}

}  // namespace
}  // namespace levitas::analysis

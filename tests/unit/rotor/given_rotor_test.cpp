// A rotor of given modes against what a rigid body and an oscillator are.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "plant_sim/rotor/finite_element.hpp"

namespace levitas::rotor {
namespace {

constexpr double kMass_kg = 3.0;
constexpr double kTransverse_kg_m2 = 0.03;
constexpr double kPolar_kg_m2 = 0.009;
constexpr double kCentre_m = 0.12;

GivenRotor Pump() {
  return {kMass_kg,
          kTransverse_kg_m2,
          kPolar_kg_m2,
          kCentre_m,
          {{561.0, 0.004, 1.5, {{0.04, -1.0}, {0.12, 1.0}, {0.18, -1.2}}}},
          {}};
}

TEST(GivenRotor, TiltsAboutItsCentreOfMass) {
  const ModalRotor rotor = FromGivenModes(Pump(), {0.04, 0.12, 0.18});
  ASSERT_EQ(rotor.frequency_rad_per_s.size(), 3);
  EXPECT_EQ(rotor.rigid_modes, 2);
  EXPECT_EQ(rotor.total_mass_kg, kMass_kg);
  for (int i = 0; i < 3; ++i) {
    EXPECT_DOUBLE_EQ(rotor.shapes(i, 0), 1.0 / std::sqrt(kMass_kg));
    EXPECT_DOUBLE_EQ(rotor.shapes(i, 1), (rotor.node_z_m[static_cast<std::size_t>(i)] - kCentre_m) /
                                             std::sqrt(kTransverse_kg_m2));
  }
}

// Modal coordinates of a rigid displacement give that displacement back, at any plane.
TEST(GivenRotor, FindsTheCoordinatesOfAShiftAndOfASlope) {
  const ModalRotor rotor = FromGivenModes(Pump(), {0.0, 0.05, 0.2});
  for (int i = 0; i < 3; ++i) {
    const Eigen::RowVectorXd shape = rotor.shapes.row(i);
    EXPECT_NEAR(shape.dot(rotor.rigid.col(0)), 1.0, 1e-15);
    EXPECT_NEAR(shape.dot(rotor.rigid.col(1)), rotor.node_z_m[static_cast<std::size_t>(i)], 1e-15);
  }
}

TEST(GivenRotor, BendsInAStraightLineBetweenThePointsOfAShapeAndBeyondThem) {
  const ModalRotor rotor = FromGivenModes(Pump(), {0.08, 0.12, 0.15, 0.20});
  const double scale = 1.0 / std::sqrt(1.5);
  EXPECT_NEAR(rotor.shapes(0, 2), 0.0, 1e-15);  // half way from -1 to 1
  EXPECT_NEAR(rotor.shapes(1, 2), scale, 1e-15);
  EXPECT_NEAR(rotor.shapes(2, 2), -0.1 * scale, 1e-15);  // half way from 1 to -1.2
  EXPECT_NEAR(rotor.shapes(3, 2), (-1.2 - 2.2 / 3.0) * scale, 1e-14);
  EXPECT_DOUBLE_EQ(rotor.frequency_rad_per_s[2], 2.0 * std::numbers::pi * 561.0);
  EXPECT_EQ(rotor.damping_ratio[2], 0.004);
}

// The tilting rigid body precesses at Ip/It of the speed (Euler), the bending mode stays where it
// is.
TEST(GivenRotor, HasTheGyroscopicsOfARigidBodyAlone) {
  const ModalRotor rotor = FromGivenModes(Pump(), {0.04, 0.18});
  EXPECT_DOUBLE_EQ(rotor.gyroscopic(1, 1), kPolar_kg_m2 / kTransverse_kg_m2);
  EXPECT_EQ(rotor.gyroscopic.cwiseAbs().sum(), rotor.gyroscopic(1, 1));
  const WhirlFrequencies whirl = FreeWhirl(rotor, 3000.0, 3);
  ASSERT_EQ(whirl.forward_hz.size(), 1U);
  EXPECT_NEAR(whirl.forward_hz[0], 561.0, 1e-9);
  EXPECT_NEAR(whirl.backward_hz[0], 561.0, 1e-9);
}

// One mode alone whirls as a disc on a spring: l^2 - g W l - w^2 = 0.
TEST(GivenRotor, WhirlsWithTheGyroscopicRatioOfAMode) {
  GivenRotor given = Pump();
  given.gyroscopic = {{1, 1, 0.4}};
  const WhirlFrequencies whirl = FreeWhirl(FromGivenModes(given, {0.04, 0.18}), 3000.0, 1);
  const double w = 2.0 * std::numbers::pi * 561.0;
  const double half = 0.5 * 0.4 * 3000.0;
  const double root = std::sqrt(half * half + w * w);
  EXPECT_NEAR(whirl.forward_hz[0], (root + half) / (2.0 * std::numbers::pi), 1e-9);
  EXPECT_NEAR(whirl.backward_hz[0], (root - half) / (2.0 * std::numbers::pi), 1e-9);
}

TEST(GivenRotor, CouplesTiltAndModeAlikeFromEitherSide) {
  GivenRotor given = Pump();
  given.gyroscopic = {{1, 0, -0.2}};
  const ModalRotor rotor = FromGivenModes(given, {0.04, 0.18});
  EXPECT_EQ(rotor.gyroscopic(1, 2), -0.2);
  EXPECT_EQ(rotor.gyroscopic(2, 1), -0.2);
  EXPECT_DOUBLE_EQ(rotor.gyroscopic(1, 1), kPolar_kg_m2 / kTransverse_kg_m2);
}

TEST(GivenRotor, WithoutTransverseInertiaIsAPointThatCannotTilt) {
  GivenRotor point{0.5, 0.0, 0.0, 0.0, {}, {}};
  const ModalRotor rotor = FromGivenModes(point, {0.0});
  EXPECT_EQ(rotor.rigid_modes, 1);
  EXPECT_EQ(rotor.frequency_rad_per_s.size(), 1);
  EXPECT_DOUBLE_EQ(rotor.rigid(0, 0), std::sqrt(0.5));
}

TEST(GivenRotor, RefusesWhatIsNoRotor) {
  const auto expect_refused = [](const GivenRotor& rotor) {
    EXPECT_THROW((void)FromGivenModes(rotor, {0.04}), std::invalid_argument);
  };
  GivenRotor rotor = Pump();
  rotor.mass_kg = 0.0;
  expect_refused(rotor);
  rotor = Pump();
  rotor.polar_inertia_kg_m2 = std::nan("");
  expect_refused(rotor);
  rotor = Pump();
  rotor.modes[0].modal_mass_kg = -1.0;
  expect_refused(rotor);
  rotor = Pump();
  rotor.modes[0].shape.clear();
  expect_refused(rotor);
  rotor = Pump();
  rotor.modes[0].shape[1].z_m = 0.04;
  expect_refused(rotor);
  rotor = Pump();
  rotor.gyroscopic = {{2, 0, 0.1}};  // one mode only
  expect_refused(rotor);
  rotor.gyroscopic = {{0, 0, 0.1}};  // the tilt's is Ip/It
  expect_refused(rotor);
}

}  // namespace
}  // namespace levitas::rotor

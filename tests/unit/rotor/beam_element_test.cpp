#include "plant_sim/rotor/beam_element.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "plant_sim/rotor/finite_element.hpp"

namespace levitas::rotor {
namespace {

constexpr Material kSteel{210e9, 0.3, 7850.0};
constexpr Section kStub{0.1, 0.05, 0.02};

TEST(BeamElement, DoesNotResistRigidMotion) {
  const auto element = MakeBeamElement(kSteel, kStub);
  const Eigen::Vector4d translation(1.0, 0.0, 1.0, 0.0);
  const Eigen::Vector4d rotation(0.0, 1.0, 0.1, 1.0);
  const double scale = element.stiffness.cwiseAbs().maxCoeff();
  EXPECT_LT((element.stiffness * translation).norm() / scale, 1e-14);  // rounding
  EXPECT_LT((element.stiffness * rotation).norm() / scale, 1e-14);
}

TEST(BeamElement, HasTheMassAndInertiaOfTheCylinder) {
  const auto element = MakeBeamElement(kSteel, kStub);
  const double pi = std::numbers::pi;
  const double mass = 7850.0 * pi / 4.0 * (0.05 * 0.05 - 0.02 * 0.02) * 0.1;
  const Eigen::Vector4d translation(1.0, 0.0, 1.0, 0.0);
  EXPECT_NEAR(translation.dot(element.mass * translation) / mass, 1.0, 1e-12);
  // About the first end: m L^2/3 + m (ro^2 + ri^2)/4.
  const Eigen::Vector4d rotation(0.0, 1.0, 0.1, 1.0);
  const double inertia = mass * (0.01 / 3.0 + (0.025 * 0.025 + 0.01 * 0.01) / 4.0);
  EXPECT_NEAR(rotation.dot(element.mass * rotation) / inertia, 1.0, 1e-12);
  // Polar inertia of the whole: m (ro^2 + ri^2)/2, by tilting without bending.
  const double polar = mass * (0.025 * 0.025 + 0.01 * 0.01) / 2.0;
  EXPECT_NEAR(rotation.dot(element.gyroscopic * rotation) / polar, 1.0, 1e-12);
}

TEST(BeamElement, BendsAndShearsAsTimoshenkosCantilever) {
  const auto element = MakeBeamElement(kSteel, kStub);
  const Eigen::Vector2d tip =
      element.stiffness.bottomRightCorner<2, 2>().inverse() * Eigen::Vector2d(1000.0, 0.0);
  const double pi = std::numbers::pi;
  const double bending = 210e9 * pi / 64.0 * (std::pow(0.05, 4) - std::pow(0.02, 4));
  const double area = pi / 4.0 * (0.05 * 0.05 - 0.02 * 0.02);
  const double kappa = 6.0 * 1.3 / (7.0 + 6.0 * 0.3);
  const double shear = kappa * 210e9 / 2.6 * area;
  // P L^3/(3 E I) + P L/(kappa G A); slope P L^2/(2 E I): exact for the element.
  EXPECT_NEAR(tip[0] / (1000.0 * 1e-3 / (3.0 * bending) + 1000.0 * 0.1 / shear), 1.0, 1e-10);
  EXPECT_NEAR(tip[1] / (1000.0 * 1e-2 / (2.0 * bending)), 1.0, 1e-10);
}

TEST(FreeWhirl, OfASlenderBeamIsEulersClosedForm) {
  // Free-free: (beta L)^2 = 22.3733, 61.6728, 120.903 (Blevins 1979).
  RotorConfig config;
  config.material = kSteel;
  config.sections = {{2.0, 0.004, 0.0}};
  config.max_element_length_m = 0.05;
  const auto whirl = FreeWhirl(Assemble(config, {}), 0.0, 3);
  const double radius_of_gyration_m = 0.001;
  const double factor =
      radius_of_gyration_m * std::sqrt(210e9 / 7850.0) / 4.0 / (2.0 * std::numbers::pi);
  const double euler[] = {22.3733, 61.6728, 120.903};
  ASSERT_EQ(whirl.forward_hz.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    // Shear and rotary inertia take (beta k)^2 (1 + E/(kappa G))/2 = 6e-5 of the third mode.
    EXPECT_NEAR(whirl.forward_hz[i] / (euler[i] * factor), 1.0, 1e-4) << i;
  }
}

}  // namespace
}  // namespace levitas::rotor

#include "plant_sim/rotor/lumped_shaft.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <stdexcept>

namespace levitas::rotor {
namespace {

LumpedShaft Tilting() {
  LumpedShaft shaft;
  shaft.z_m = 0.2;
  shaft.mass_kg = 2.0;
  shaft.diametral_inertia_kg_m2 = 1.8e-3;
  shaft.polar_inertia_kg_m2 = 3.4e-3;
  SetSimplySupported(shaft, 0.5, 480.0);
  return shaft;
}

TEST(SimplySupported, DiscInTheMiddleIsTheBeamTable) {
  LumpedShaft shaft = Tilting();
  shaft.z_m = 0.25;
  SetSimplySupported(shaft, 0.5, 480.0);
  // 48 EI/L^3 for the load in the middle, no tilt under it; 12 EI/L for a moment there.
  EXPECT_NEAR(shaft.kll_n_per_m, 48.0 * 480.0 / 0.125, 1e-6);
  EXPECT_NEAR(shaft.kla_n, 0.0, 1e-6);
  EXPECT_NEAR(shaft.kaa_n_m, 12.0 * 480.0 / 0.5, 1e-8);
}

TEST(SimplySupported, LoadAsideDeflectsByTheBeamTable) {
  // Force alone: condensing the free tilt leaves 3 EI L/(a^2 b^2).
  const LumpedShaft shaft = Tilting();
  const double stiffness = shaft.kll_n_per_m - shaft.kla_n * shaft.kla_n / shaft.kaa_n_m;
  EXPECT_NEAR(stiffness, 3.0 * 480.0 * 0.5 / (0.04 * 0.09), 1e-6);
}

TEST(SimplySupported, RefusesADiscBeyondTheSupports) {
  LumpedShaft shaft = Tilting();
  shaft.z_m = 0.5;
  EXPECT_THROW(SetSimplySupported(shaft, 0.5, 480.0), std::invalid_argument);
  shaft.z_m = 0.2;
  EXPECT_THROW(SetSimplySupported(shaft, 0.5, -1.0), std::invalid_argument);
}

TEST(CondenseTilt, KeepsEnergyOfATiltThatFollows) {
  const LumpedShaft shaft = Tilting();
  const double t = -shaft.kla_n / shaft.kaa_n_m;
  const LumpedShaft stiff = CondenseTilt(shaft);
  EXPECT_FALSE(stiff.tilts);
  // Strain and kinetic energy of (r, psi) = (1, t), twice.
  EXPECT_NEAR(stiff.kll_n_per_m, shaft.kll_n_per_m + 2.0 * t * shaft.kla_n + t * t * shaft.kaa_n_m,
              1e-6);
  EXPECT_NEAR(stiff.mass_kg, 2.0 + t * t * 1.8e-3, 1e-12);
  EXPECT_EQ(CondenseTilt(stiff).mass_kg, stiff.mass_kg);
}

TEST(LumpedShaft, WithoutTiltIsOneOscillator) {
  LumpedShaft shaft;
  shaft.mass_kg = 2.0;
  shaft.kll_n_per_m = 2e5;
  const ModalRotor modal = Reduce(shaft);
  ASSERT_EQ(modal.frequency_rad_per_s.size(), 1);
  EXPECT_NEAR(modal.frequency_rad_per_s[0], std::sqrt(1e5), 1e-9);
  EXPECT_NEAR(std::abs(modal.ShapeAt(0.0)[0]), 1.0 / std::sqrt(2.0), 1e-12);
  EXPECT_EQ(modal.gyroscopic(0, 0), 0.0);
}

TEST(LumpedShaft, WithTiltHasModesThatGiveBackItsMatrices) {
  const LumpedShaft shaft = Tilting();
  const ModalRotor modal = Reduce(shaft);
  ASSERT_EQ(modal.frequency_rad_per_s.size(), 2);
  Eigen::Matrix2d phi;
  phi << modal.shapes.row(0), modal.slopes.row(0);
  const Eigen::Matrix2d inverse = phi.inverse();
  const Eigen::Matrix2d mass = inverse.transpose() * inverse;
  EXPECT_NEAR(mass(0, 0), 2.0, 1e-9);
  EXPECT_NEAR(mass(0, 1), 0.0, 1e-9);
  EXPECT_NEAR(mass(1, 1), 1.8e-3, 1e-12);
  const Eigen::Matrix2d stiffness =
      inverse.transpose() * modal.frequency_rad_per_s.cwiseAbs2().asDiagonal() * inverse;
  EXPECT_NEAR(stiffness(0, 1), shaft.kla_n, 1e-6 * std::abs(shaft.kla_n));
  const Eigen::Matrix2d gyroscopic = inverse.transpose() * modal.gyroscopic * inverse;
  EXPECT_NEAR(gyroscopic(0, 0), 0.0, 1e-12);
  EXPECT_NEAR(gyroscopic(1, 1), 3.4e-3, 1e-12);
}

TEST(LumpedShaft, RefusesWhatHoldsNoDisc) {
  LumpedShaft shaft = Tilting();
  shaft.kla_n = 2.0 * std::sqrt(shaft.kll_n_per_m * shaft.kaa_n_m);
  EXPECT_THROW((void)Reduce(shaft), std::invalid_argument);
  shaft = Tilting();
  shaft.mass_kg = 0.0;
  EXPECT_THROW((void)Reduce(shaft), std::invalid_argument);
}

}  // namespace
}  // namespace levitas::rotor

#include "plant_sim/rotor/torsion_line.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace levitas::rotor {
namespace {

Torsion TwoInertias() {
  return {TorsionKind::kInertias,
          {{"motor", 5.0e-3, 1830.0, 0.0, 0.0}, {"pinion", 3.4e-3, 0.0, 0.0, 0.0}},
          1,
          0.01,
          {}};
}

TEST(TorsionLine, OfTwoInertiasTurnsFreelyAndVibratesAgainstEachOther) {
  const ModalTorsion modal = ReduceTorsion(TwoInertias());
  ASSERT_EQ(modal.frequency_rad_per_s.size(), 2);
  EXPECT_EQ(modal.frequency_rad_per_s[0], 0.0);
  EXPECT_EQ(modal.damping_ratio[0], 0.0);
  // k (1/J1 + 1/J2)
  EXPECT_NEAR(modal.frequency_rad_per_s[1], std::sqrt(1830.0 * (1.0 / 5.0e-3 + 1.0 / 3.4e-3)),
              1e-6);
  EXPECT_EQ(modal.damping_ratio[1], 0.01);
  // As a whole: both turn alike, with the whole inertia.
  EXPECT_NEAR(std::abs(modal.shapes(0, 0)), 1.0 / std::sqrt(8.4e-3), 1e-6);
  EXPECT_NEAR(modal.shapes(0, 0), modal.shapes(1, 0), 1e-6);
}

TEST(TorsionLine, HeldByItsDriveHasNoFreeRotation) {
  Torsion torsion = TwoInertias();
  torsion.inertias[0].ground_stiffness_n_m_per_rad = 13.0;
  // Slow against the shaft's own mode: both inertias together on the drive, within a per cent.
  EXPECT_NEAR(ReduceTorsion(torsion).frequency_rad_per_s[0], std::sqrt(13.0 / 8.4e-3), 0.4);
}

TEST(TorsionLine, RefusesAGearOnNothing) {
  Torsion torsion = TwoInertias();
  torsion.gear_at = 2;
  EXPECT_THROW((void)ReduceTorsion(torsion), std::invalid_argument);
  torsion = TwoInertias();
  torsion.inertias[1].inertia_kg_m2 = 0.0;
  EXPECT_THROW((void)ReduceTorsion(torsion), std::invalid_argument);
}

TEST(TorsionOfABeam, HasTheFrequenciesOfAUniformBar) {
  // Free bar: w_n = n pi/l sqrt(G/rho) (Timoshenko, vibration problems). Linear elements of which
  // forty make a bar err by (n pi/40)^2/24.
  RotorConfig beam;
  beam.material = {207e9, 0.3, 7800.0};
  beam.sections = {{1.0, 0.05, 0.0}};
  std::vector<double> nodes;
  for (int i = 0; i <= 40; ++i) nodes.push_back(i / 40.0);
  const ModalTorsion modal = ReduceTorsion(beam, nodes, 0.0);
  EXPECT_EQ(modal.frequency_rad_per_s[0], 0.0);
  const double speed = std::sqrt(207e9 / 2.6 / 7800.0);
  for (int n = 1; n <= 3; ++n) {
    const double exact = n * std::numbers::pi * speed;
    EXPECT_NEAR(modal.frequency_rad_per_s[n], exact, 0.003 * exact) << n;
  }
}

TEST(TorsionOfABeam, CarriesItsDiscsAndRings) {
  RotorConfig beam;
  beam.material = {207e9, 0.3, 1e-3};  // a shaft without inertia worth the name
  beam.sections = {{0.5, 0.02, 0.0}};
  beam.discs = {{0.0, 1.0, 0.01, 0.02}};
  beam.rings = {{0.5, 0.02, 0.02, 0.2, 7800.0}};
  const std::vector<double> nodes{0.0, 0.25, 0.5};
  const ModalTorsion modal = ReduceTorsion(beam, nodes, 0.0);
  const double k = 207e9 / 2.6 * std::numbers::pi / 32.0 * std::pow(0.02, 4) / 0.5;
  const double ring_mass = 7800.0 * std::numbers::pi * (0.01 - 1e-4) * 0.02;
  const double ring = 0.5 * ring_mass * (0.01 + 1e-4);
  EXPECT_NEAR(modal.frequency_rad_per_s[1], std::sqrt(k * (1.0 / 0.02 + 1.0 / ring)), 0.05);
}

}  // namespace
}  // namespace levitas::rotor

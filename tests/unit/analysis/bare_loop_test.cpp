#include "analysis/bare_loop.hpp"

#include <gtest/gtest.h>

#include "tests/support/test_rigs.hpp"
#include "tests/unit/analysis/laws.hpp"

namespace levitas::analysis {
namespace {

// [A/m, A s/m] Twice what the magnets' own stiffness needs, damped to 0.4: settles within 30 ms.
constexpr double kBareKp = 6000.0;
constexpr double kBareKd = 8.0;

plant::PlantConfig RigidRig() { return test::RigidRotor(2.0); }

/// What the probes show after 0.2 s: the vibration falls to a third in some 10 ms.
AxisArray SettledWith(const AxisArray& excitation_a, const AxisArray& excitation_m) {
  const plant::PlantConfig rig = RigidRig();
  BareLoop loop(rig, test::PdLaw(rig, kBareKp, kBareKd, 2000.0));
  AxisArray seen_m{};
  for (int i = 0; i < 2000; ++i) seen_m = loop.Step(excitation_a, excitation_m);
  return seen_m;
}

/// Force per current and per displacement, as the description of the magnet has them.
struct CoilSlope {
  double ki, ks;
};
CoilSlope SlopeOf(const plant::MagnetConfig& m) {
  const double ki = 4.0 * m.force_constant_n_m2_per_a2 * m.bias_current_a / (m.gap_m * m.gap_m);
  return {ki, ki * m.bias_current_a / m.gap_m};
}

TEST(BareLoop, ShowsTheRotorWhereItWasPlaced) {
  const plant::PlantConfig rig = test::RigidCylinder();  // probes in the planes of the coils
  BareLoop loop(rig, test::PdLaw(rig, kBareKp, kBareKd, 2000.0));
  const AxisArray placed_m{20e-6, -5e-6, -10e-6, 15e-6};
  loop.PlaceAtRest(placed_m);
  const AxisArray seen_m = loop.Step();
  EXPECT_EQ(loop.axes(), 4U);
  // By the modes of the rotor and back: rounding, and no step of a converter (tens of nm).
  for (std::size_t axis = 0; axis < 4; ++axis) EXPECT_NEAR(seen_m[axis], placed_m[axis], 1e-12);
}

TEST(BareLoop, KnowsNeitherWiringNorNoiseNorConvertersNorAnotherPeriodOfTheLaw) {
  const plant::PlantConfig plain = test::QuietFlexibleRotor();
  law::LawConfig law = test::FlexibleRotorLaw();
  BareLoop expected(plain, law);
  plant::PlantConfig wired = plain;
  wired.sensor_polarity = {-1.0, 1.0, -1.0, 1.0};
  wired.actuator_polarity = {1.0, -1.0, -1.0, 1.0};
  for (auto& bearing : wired.bearings) {
    bearing.amplifier.dac_bits = 8;
    bearing.sensor.noise_rms_m = 1e-6;
    bearing.sensor.adc_bits = 8;
  }
  law.period_s = 1e-3;  // the rig's is 1e-4
  BareLoop found(wired, law);
  expected.PlaceAtRest({20e-6, 10e-6, 5e-6, -5e-6});
  found.PlaceAtRest({20e-6, 10e-6, 5e-6, -5e-6});
  for (int i = 0; i < 200; ++i) ASSERT_EQ(found.Step(), expected.Step()) << "period " << i;
  EXPECT_TRUE(found.finite());
}

// At rest ki ic + ks x = 0 with ic = -kp (x + e_m) + e_a, so x = ki (e_a - kp e_m)/(kp ki - ks).
// That is exact: at x/s0 = -ic/i0 the forces of both coils are equal. What is left of the vibration
// after 0.2 s is less than 1e-4 of it.
TEST(BareLoop, AddsATestCurrentToThatOfTheLawAndATestPositionToWhatTheLawReads) {
  const auto [ki, ks] = SlopeOf(RigidRig().bearings[0].magnet);
  const double room = kBareKp * ki - ks;
  ASSERT_GT(room, 0.0);
  const double by_current_m = ki * 0.01 / room;
  const double by_position_m = -ki * kBareKp * 1e-6 / room;
  const AxisArray of_current = SettledWith({0.01, 0.0, 0.01, 0.0}, {});
  const AxisArray of_position = SettledWith({}, {1e-6, 0.0, 1e-6, 0.0});
  for (const std::size_t axis : {0U, 2U}) {
    EXPECT_NEAR(of_current[axis], by_current_m, 1e-4 * by_current_m);
    EXPECT_NEAR(of_position[axis], by_position_m, -1e-4 * by_position_m);
  }
  EXPECT_EQ(of_current[1], 0.0) << "the other plane";
  EXPECT_EQ(of_position[3], 0.0);
}

}  // namespace
}  // namespace levitas::analysis

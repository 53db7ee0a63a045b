// The shipped rig with the shipped controller: nonlinear plant, noise, converters, gravity.

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/loop/levitation/closed_loop.hpp"

namespace levitas::test {
namespace {

// The harm: magnets biased, no law. Released in the centre, the rotor falls and is pulled on by its
// own negative stiffness until it lies in the touchdown bearings.
TEST(LevitationPair, RotorFallsWithoutTheLaw) {
  ClosedLoop loop;
  loop.plant.PlaceAtRest({});
  loop.overrule = [](plant::PlantCommand& command) {
    command.amplifiers_enabled = true;
    command.bias_current_a = 1.0;
    command.control_current_a = {};
  };
  loop.Run(0.1);
  EXPECT_GE(loop.most.shaft_m, 190e-6);
  EXPECT_GT(loop.most.contact_n, 23.0);  // more than the rotor's whole weight
}

TEST(LevitationPair, RotorSettlesWithTheLaw) {
  ClosedLoop loop;
  ASSERT_TRUE(loop.Levitate()) << Name(loop.out.fault);
  loop.Run(0.5);
  loop.Reset();
  loop.Run(1.0);
  EXPECT_EQ(loop.most.contact_n, 0.0);
  EXPECT_LT(loop.most.orbit_m, 0.1 * 190e-6);  // a tenth of the clearance
}

TEST(Levitation, StandsQuieterThanTheObjective) {
  ClosedLoop loop(CommissionedCycle());
  ASSERT_TRUE(loop.Levitate());
  loop.Run(0.5);
  loop.Reset();
  loop.Run(2.0);
  EXPECT_LT(loop.most.orbit_m, 7e-6);  // the rig's objective, for every one of 20 000 samples
}

// The reference gains let 1 um of noise reach the current limit; every such cycle lacks damping, so
// their largest orbit is a matter of luck. What does not depend on it is the rms radius.
TEST(Levitation, ReferenceLawMeetsTheStandingObjectiveInTheMean) {
  ClosedLoop loop;
  ASSERT_TRUE(loop.Levitate());
  loop.Run(0.5);
  std::array<double, 2> square{};
  constexpr int kCycles = 20'000;
  for (int n = 0; n < kCycles; ++n) {
    (void)loop.Step();
    const AxisArray y = loop.plant.SensorOutput();
    for (std::size_t b = 0; b < 2; ++b) {
      square[b] += (y[2 * b] * y[2 * b] + y[2 * b + 1] * y[2 * b + 1]) / kCycles;
    }
  }
  for (const double mean_square : square) EXPECT_LT(std::sqrt(mean_square), 7e-6);
}

// Static balance of each axis, Newton's second law for the mean: the magnets carry the rotor's
// share, and the linear magnet explains the mean current from it.
TEST(Levitation, IntegratorTakesTheStaticLoad) {
  ClosedLoop loop;
  ASSERT_TRUE(loop.Levitate());
  loop.Run(1.0);
  AxisArray sensor_m{}, shaft_m{}, force_n{}, current_a{};
  constexpr int kCycles = 40'000;
  for (int n = 0; n < kCycles; ++n) {
    (void)loop.Step();
    const AxisArray y = loop.plant.SensorOutput();
    const AxisArray x = loop.plant.ActuatorPosition();
    const AxisArray f = loop.plant.MagnetForce();
    for (std::size_t i = 0; i < 4; ++i) {
      sensor_m[i] += y[i] / kCycles;
      shaft_m[i] += x[i] / kCycles;
      force_n[i] += f[i] / kCycles;
      current_a[i] += loop.out.current.control_current_a[i] / kCycles;
    }
  }
  // Weights of the rotor file, moments about the drive-end magnet.
  const plant::PlantConfig& rig = ShippedRig().plant;
  const auto& section = rig.rotor.sections.front();
  const double shaft_kg = rig.rotor.material.density_kg_per_m3 * section.length_m *
                          3.14159265358979 / 4.0 * std::pow(section.outer_diameter_m, 2);
  const double de_z = rig.bearings[0].actuator_z_m;
  const double span_m = rig.bearings[1].actuator_z_m - de_z;
  double weight_n = 9.81 * shaft_kg;
  double moment_nm = weight_n * (0.5 * section.length_m - de_z);
  for (const auto& disc : rig.rotor.discs) {
    weight_n += 9.81 * disc.mass_kg;
    moment_nm += 9.81 * disc.mass_kg * (disc.z_m - de_z);
  }
  const double nde_n = moment_nm / span_m;
  constexpr double kKiNPerA = 40.0;                   // N/A
  constexpr double kKsNPerM = 40.0 * 1.0 / 0.381e-3;  // N/m
  for (std::size_t i = 0; i < 4; ++i) {
    // Axes at 45 degrees to the vertical: each carries 1/sqrt(2) of its bearing's share, upwards.
    const double share_n = (i < 2 ? weight_n - nde_n : nde_n) / std::sqrt(2.0);
    // The mean of 4 s of a noise-driven motion of 1.4 um rms with a memory of about 10 ms is known
    // to 1.4/sqrt(400) = 0.07 um; the limit at 1 A, reached more often on the loaded side, adds
    // 0.15 um.
    EXPECT_LT(std::abs(sensor_m[i]), 0.5e-6) << i;
    EXPECT_NEAR(force_n[i], share_n, 0.01 * share_n) << i;  // sampled force against mean force
    // The shaft droops between its bearings, so at the magnets it hangs some um below the sensors'
    // zero and ks asks for more current. 3 %: the magnet is linear only to first order.
    EXPECT_NEAR(kKiNPerA * current_a[i] + kKsNPerM * shaft_m[i], share_n, 0.03 * share_n) << i;
    EXPECT_LT(shaft_m[i], 0.0);
    EXPECT_GT(shaft_m[i], -10e-6);
  }
}

TEST(Levitation, LiftsFromTheTouchdownBearingAndLands) {
  ClosedLoop loop;
  EXPECT_NEAR(loop.plant.ActuatorPosition()[0], -190e-6 / std::sqrt(2.0), 2e-6);  // at rest
  ASSERT_TRUE(loop.Levitate());
  loop.Run(0.5);
  loop.Reset();
  loop.Command(OperatorCommand::kLand);
  EXPECT_TRUE(loop.RunUntil(2.0, [&] { return loop.out.mode == Mode::kOff; }));
  loop.Run(0.2);
  EXPECT_EQ(loop.out.fault, Fault::kNone);
  EXPECT_NEAR(loop.plant.ActuatorPosition()[0], -190e-6 / std::sqrt(2.0), 2e-6);
  EXPECT_NEAR(loop.plant.ActuatorPosition()[3], -190e-6 / std::sqrt(2.0), 2e-6);
  // Lowered, not dropped: the release costs less than three times the static load of a bearing
  // (12 N). A free fall from the centre hits with 100 N (see the safe states).
  EXPECT_LT(loop.most.contact_n, 36.0);
}

TEST(Levitation, RunsUpTo6000RpmBelowTheObjectiveWithNoise) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    ClosedLoop loop(CommissionedCycle(), ShippedRig().plant, seed);
    ASSERT_TRUE(loop.Levitate());
    loop.Run(0.5);
    loop.Reset();
    loop.Command(OperatorCommand::kSpin, 6000.0, 800.0);
    EXPECT_TRUE(loop.RunUntil(12.0, [&] { return loop.speed_rpm() > 5999.0; }));
    loop.Run(0.5);
    EXPECT_EQ(loop.out.mode, Mode::kSpinning) << Name(loop.out.fault);
    EXPECT_LT(loop.most.orbit_m, 36e-6) << "seed " << seed;  // the rig's objective
    EXPECT_EQ(loop.most.contact_n, 0.0);
    EXPECT_GE(loop.most.low_coil_a, 0.0);
    EXPECT_LE(loop.most.high_coil_a, 2.0);
  }
}

TEST(Levitation, GivesTheSameBitsForTheSameSeed) {
  ClosedLoop one(ShippedCycle(), ShippedRig().plant, 5);
  ClosedLoop other(ShippedCycle(), ShippedRig().plant, 5);
  ClosedLoop third(ShippedCycle(), ShippedRig().plant, 6);
  bool differs = false;
  for (ClosedLoop* loop : {&one, &other, &third}) loop->Command(OperatorCommand::kLift);
  for (int n = 0; n < 20'000; ++n) {
    (void)one.Step();
    (void)other.Step();
    (void)third.Step();
    ASSERT_EQ(one.out.current.control_current_a, other.out.current.control_current_a) << n;
    differs = differs || one.out.current.control_current_a != third.out.current.control_current_a;
  }
  EXPECT_TRUE(differs);
}

// Probes and coils wired the other way round, told to both sides: the same rotor, levitated.
TEST(Levitation, WorksWithInvertedProbesAndCoils) {
  plant::PlantConfig rig = ShippedRig().plant;
  cycle::CycleConfig config = ShippedCycle();
  rig.sensor_polarity = config.rig.sensor_polarity = {-1, 1, 1, -1};
  rig.actuator_polarity = config.rig.actuator_polarity = {1, 1, -1, -1};
  ClosedLoop loop(config, rig);
  EXPECT_TRUE(loop.Levitate()) << Name(loop.out.fault);
  // Told to one side only, the axis is driven the wrong way and the lift fails.
  config.rig.actuator_polarity[0] = -1;
  ClosedLoop crossed(config, rig);
  EXPECT_FALSE(crossed.Levitate());
  EXPECT_EQ(crossed.out.mode, Mode::kTripped);
}

}  // namespace
}  // namespace levitas::test

// Coils on a voltage within the plant: both of an axis against their equation, and its linear form.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "plant_sim/plant/linear_model.hpp"
#include "plant_sim/plant/parameter_access.hpp"
#include "plant_sim/plant/plant.hpp"
#include "plant_sim/plant/plant_model.hpp"
#include "tests/support/test_rigs.hpp"

namespace levitas::plant {
namespace {

constexpr double kGap_m = 0.4e-3;

/// So heavy that nothing moves it: what is left is the coils.
PlantConfig OnVoltage(const VoltageDrive& drive) {
  PlantConfig config = test::RigidRotor(1e9);
  config.period_ns = 1'000'000;
  config.delay_samples = 0.0;
  config.substeps = 20;
  for (BearingConfig& bearing : config.bearings) {
    bearing.magnet.gap_m = kGap_m;
    bearing.amplifier.voltage = drive;
  }
  return config;
}

VoltageDrive Complete() {
  VoltageDrive drive{1.1, 0.03, 20e-3, 0.3e-3, 0.0};
  drive.dead_band_a = 0.09;
  drive.curvature = 0.3;
  drive.iron_1_per_a2 = 0.3;
  drive.warming_1_per_s = 1.5;
  drive.away_steady_ratio = 0.9;
  drive.away_time_constant_ratio = 1.4;
  return drive;
}

double Asked(std::size_t cycle) {
  return 0.6 * std::sin(0.05 * static_cast<double>(cycle)) + (cycle % 40 < 20 ? 0.3 : -0.3);
}

/// One coil of the rig above, 2 us a step by the midpoint rule.
double Integrated(const VoltageDrive& v, bool away, double bias_a, double full_a,
                  std::size_t cycles) {
  constexpr double kStep_s = 2e-6;
  const double steady = v.steady * (away ? v.away_steady_ratio : 1.0);
  const double tau_s =
      v.time_constant_s * (away ? v.away_time_constant_ratio : 1.0) * std::exp(-kGap_m / v.decay_m);
  double now_a = bias_a;
  for (std::size_t n = 0; n < cycles; ++n) {
    const double c = std::clamp(bias_a + (away ? -1.0 : 1.0) * Asked(n), 0.0, full_a);
    const double beyond = std::max(0.0, c - v.dead_band_a);
    const double last = steady * (beyond + v.curvature * beyond * (1.0 - c / full_a)) + v.offset_a;
    for (int k = 0; k < 500; ++k) {
      const double r = 1.0 + v.warming_1_per_s * (1e-3 * static_cast<double>(n) + kStep_s * k);
      const auto slope = [&](double i) {
        return (last - r * i) * (1.0 + v.iron_1_per_a2 * i * i) / tau_s;
      };
      now_a = std::max(0.0, now_a + kStep_s * slope(now_a + 0.5 * kStep_s * slope(now_a)));
    }
  }
  return now_a;
}

Plant After(const PlantConfig& config, std::size_t cycles) {
  Plant plant(config, 1);
  plant.PlaceAtRest({});
  for (std::size_t n = 0; n < cycles; ++n) {
    PlantCommand command;
    command.bias_current_a = config.bearings[0].magnet.bias_current_a;
    command.control_current_a[0] = Asked(n);
    plant.Advance(command);
  }
  return plant;
}

double ControlAfter(const PlantConfig& config, std::size_t cycles) {
  const Plant plant = After(config, cycles);
  return plant.state()[plant.layout().coil_current];
}

/// Of both coils, so that what they have in common shows too.
double ForceAfter(const PlantConfig& config) { return After(config, 30).MagnetForce()[0]; }

TEST(VoltageDrive, FollowsItsEquationInBothCoilsOfAnAxis) {
  const VoltageDrive drive = Complete();
  const PlantConfig config = OnVoltage(drive);
  const MagnetConfig& magnet = config.bearings[0].magnet;
  for (const std::size_t cycles : {7U, 55U, 240U}) {
    const auto coil = [&](bool away) {
      return Integrated(drive, away, magnet.bias_current_a, magnet.max_coil_current_a, cycles);
    };
    // Iron is taken at the start of a substep of 50 us: 1e-3 of the current where it is steepest.
    EXPECT_NEAR(ControlAfter(config, cycles), 0.5 * (coil(false) - coil(true)), 2e-3) << cycles;
  }
}

// What the law has none of changes nothing, to the bit; and each of its numbers changes something.
TEST(VoltageDrive, IsThePlainCoilUnlessTheFileSaysMore) {
  const VoltageDrive plain{1.1, 0.03, 20e-3, 0.3e-3, 0.0};
  const double expected_n = ForceAfter(OnVoltage(plain));
  for (const char* name : {"dead_band_a", "curvature", "iron_1_per_a2", "warming_1_per_s",
                           "away_steady_ratio", "away_time_constant_ratio"}) {
    PlantParameters parameters = Reduce(OnVoltage(plain));
    const std::string at = std::string("bearings[0].amplifier.") + name;
    const double neutral = GetParameter(parameters, at);
    EXPECT_EQ(neutral, std::string(name).starts_with("away") ? 1.0 : 0.0);
    SetParameter(parameters, at, neutral + 0.2);
    EXPECT_GT(std::abs(ForceAfter(parameters.config) - expected_n), 1e-3 * std::abs(expected_n))
        << name;
    SetParameter(parameters, at, neutral);
    EXPECT_EQ(ForceAfter(parameters.config), expected_n) << name;
  }
}

// About a bias at which the coils rest, by central differences of a period.
TEST(VoltageDrive, HasTheLinearFormOfItsDriveAndIron) {
  VoltageDrive drive = Complete();
  drive.warming_1_per_s = 0.0;
  drive.away_steady_ratio = drive.away_time_constant_ratio = 1.0;
  PlantConfig config = OnVoltage(drive);
  const double bias_a = config.bearings[0].magnet.bias_current_a;
  const double full_a = config.bearings[0].magnet.max_coil_current_a;
  const double beyond = bias_a - drive.dead_band_a;
  const double offset_a =
      bias_a - drive.steady * beyond * (1.0 + drive.curvature * (1.0 - bias_a / full_a));
  for (BearingConfig& bearing : config.bearings) bearing.amplifier.voltage->offset_a = offset_a;
  const auto model = Discretise(Linearise(config, 0.0), 1e-3, 0.0);
  const auto after = [&](double control_a) {
    Plant plant(config, 1);
    plant.PlaceAtRest({});
    PlantCommand command;
    command.bias_current_a = bias_a;
    command.control_current_a[0] = control_a;
    plant.Advance(command);
    return plant.state()[plant.layout().coil_current];
  };
  const double h = 1e-4;
  const auto coil = static_cast<Eigen::Index>(Plant(config, 1).layout().coil_current);
  EXPECT_NEAR(model.b(coil, 0), (after(h) - after(-h)) / (2.0 * h), 1e-6);
  EXPECT_NEAR(after(0.0), 0.0, 1e-12);
}

}  // namespace
}  // namespace levitas::plant

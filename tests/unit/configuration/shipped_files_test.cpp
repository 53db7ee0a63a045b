// The shipped files hold the numbers of their sources.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>

#include "common/rotational_speed.hpp"
#include "configuration/rig_file.hpp"
#include "tests/support/paths.hpp"

namespace levitas::configuration {
namespace {

double Ki(const plant::MagnetConfig& m) {
  return 4.0 * m.force_constant_n_m2_per_a2 * m.bias_current_a / (m.gap_m * m.gap_m);
}
double Ks(const plant::MagnetConfig& m) { return Ki(m) * m.bias_current_a / m.gap_m; }

TEST(FlexibleRotor, IsThePublishedRig) {
  const RigFile rig = LoadRig(FindConfig("flexible_rotor", "rigs"));
  EXPECT_EQ(rig.numbers.channels, (std::vector<std::string>{"de_x", "de_y", "nde_x", "nde_y"}));
  EXPECT_EQ(rig.numbers.bearings, (std::vector<std::string>{"de", "nde"}));
  EXPECT_EQ(rig.numbers.period_ns, 100'000);
  EXPECT_EQ(rig.plant.period_ns, 100'000);
  EXPECT_EQ(rig.plant.delay_samples, 1.0);
  EXPECT_EQ(rig.numbers.clearance_m, 190e-6);
  EXPECT_EQ(rig.numbers.standing_orbit_objective_m, 7e-6);
  EXPECT_EQ(rig.numbers.spinning_orbit_objective_m, 36e-6);
  EXPECT_DOUBLE_EQ(rig.numbers.max_speed_rad_per_s, RpmToRadPerS(6000.0));
  EXPECT_EQ(rig.plant.rotor.sections[0].length_m, 0.4572);
  EXPECT_EQ(rig.plant.rotor.sections[0].outer_diameter_m, 9.525e-3);
  EXPECT_EQ(rig.plant.bearings[0].sensor_z_m, 0.1099);
  EXPECT_EQ(rig.plant.bearings[1].actuator_z_m, 0.3996);
  EXPECT_EQ(rig.plant.unbalance[1].moment_kg_m, 18e-6);
  for (const auto& bearing : rig.plant.bearings) {
    EXPECT_DOUBLE_EQ(Ki(bearing.magnet), 40.0);
    EXPECT_NEAR(Ks(bearing.magnet), 1.0499e5, 5.0);  // printed to five digits
    EXPECT_EQ(bearing.sensor.adc_bits, 14);
    EXPECT_EQ(bearing.sensor.range_m, 400e-6);
  }
}

TEST(FlexibleRotor, KeepsClearanceAndRangeOfEachBearing) {
  std::ifstream file(FindConfig("flexible_rotor", "rigs"));
  std::string text{std::istreambuf_iterator<char>(file), {}};
  text.replace(text.rfind("clearance_um: 190"), 17, "clearance_um: 250");
  text.replace(text.rfind("range_um: 400"), 13, "range_um: 500");
  const RigFile rig = ParseRig(text, "rig.yaml");
  EXPECT_EQ(rig.numbers.clearance_m, 190e-6);  // the smallest still stands for all together
  EXPECT_EQ(rig.numbers.sensor_range_m, 400e-6);
  EXPECT_EQ(rig.numbers.ClearanceOf(0), 190e-6);
  EXPECT_EQ(rig.numbers.ClearanceOf(1), 250e-6);
  EXPECT_EQ(rig.numbers.SensorRangeOf(1), 500e-6);
  EXPECT_EQ(rig.numbers.LargestSensorRange(), 500e-6);
}

TEST(FlexibleRotor, HasItsWeightEquallyOnBothAxes) {
  const RigFile rig = LoadRig(FindConfig("flexible_rotor", "rigs"));
  EXPECT_EQ(rig.plant.gravity_m_per_s2, 9.81);
  EXPECT_DOUBLE_EQ(rig.plant.gravity_direction_rad, 225.0 * std::numbers::pi / 180.0);
}

TEST(FlexibleRotorController, LevitatesInTheSenseOfKiKpAboveKs) {
  const RigFile rig = LoadRig(FindConfig("flexible_rotor", "rigs"));
  const ControllerFile file =
      LoadController(FindConfig("flexible_rotor", "controllers"), rig.numbers);
  ASSERT_EQ(file.law.axes.size(), 4U);
  EXPECT_EQ(file.law.period_s, 1e-4);
  EXPECT_EQ(file.law.current_limit_a, 1.0);
  for (std::size_t axis = 0; axis < 4; ++axis) {
    const auto& magnet = rig.plant.bearings[axis / 2].magnet;
    EXPECT_GT(Ki(magnet) * file.law.axes[axis].kp_a_per_m, Ks(magnet));
    EXPECT_EQ(file.law.axes[axis].notches.size(), 2U);
  }
  EXPECT_EQ(file.law.axes[0].kp_a_per_m, 4514.47);
  // The gains of the non-drive end are those of the drive end times 2.1294.
  EXPECT_DOUBLE_EQ(file.law.axes[2].kp_a_per_m, 2.1294 * 4514.47);
  EXPECT_DOUBLE_EQ(file.law.axes[2].ki_a_per_m_s, 2.1294 * 24128.6);
  EXPECT_DOUBLE_EQ(file.law.axes[2].kd_a_s_per_m, 2.1294 * 13.0414);
}

TEST(UfuRig, HasThePublishedForcesPerCurrentAndDisplacement) {
  const RigFile rig = LoadRig(FindConfig("ufu_rig", "rigs"));
  for (const auto& bearing : rig.plant.bearings) {
    EXPECT_NEAR(Ki(bearing.magnet), 55.73, 0.005);    // printed to four digits
    EXPECT_NEAR(Ks(bearing.magnet), 1.290e5, 0.5e2);  // printed to four digits
  }
}

TEST(UfuRig, HasThePublishedShaft) {
  const RigFile rig = LoadRig(FindConfig("ufu_rig", "rigs"));
  ASSERT_EQ(rig.plant.rotor.sections.size(), 52U);
  double length_m = 0.0;
  for (const auto& section : rig.plant.rotor.sections) length_m += section.length_m;
  EXPECT_NEAR(length_m, 0.6461, 1e-12);  // sum of 52 rounded lengths
  EXPECT_EQ(rig.plant.rotor.rings.size(), 19U);
  EXPECT_EQ(rig.plant.bearings[0].actuator_z_m, 0.1530);  // node 12
  EXPECT_EQ(rig.plant.bearings[1].actuator_z_m, 0.5669);  // node 43
  EXPECT_EQ(rig.plant.rotor.material.young_pa, 1.9e11);
}

TEST(Scenarios, TakeTheTimeTheySay) {
  const RigNumbers rig = LoadRig(FindConfig("flexible_rotor", "rigs")).numbers;
  const ControllerFile controller =
      LoadController(FindConfig("flexible_rotor", "controllers"), rig);
  const auto& sequence = controller.supervisor.sequence;
  double seconds = sequence.self_test_s + sequence.lift_ramp_s + sequence.lift_settle_s +
                   sequence.landing_ramp_s;
  double speed = 0.0;
  double fastest = 0.0;
  for (const auto& step : LoadScenario(FindConfig("default", "scenarios"), rig).steps) {
    seconds += step.hold_s;
    if (step.command != OperatorCommand::kSpin) continue;
    seconds += std::abs(step.speed_rad_per_s - speed) / step.acceleration_rad_per_s2;
    speed = step.speed_rad_per_s;
    fastest = std::max(fastest, speed);
  }
  EXPECT_GT(seconds, 12.0);
  EXPECT_LT(seconds, 15.0);
  EXPECT_DOUBLE_EQ(fastest, RpmToRadPerS(3000.0));
}

/// The rig whose name a file's name begins with; files for any rig are tried with the first one.
RigNumbers RigOf(const std::string& stem) {
  for (const char* name : {"turbomolecular_pump", "one_axis", "two_magnet_levitator"}) {
    if (stem.starts_with(name)) return LoadRig(FindConfig(name, "rigs")).numbers;
  }
  if (stem.starts_with("geared_rotor")) {
    return LoadRig(FindConfig("geared_rotor_4dof", "rigs")).numbers;
  }
  return LoadRig(FindConfig("flexible_rotor", "rigs")).numbers;
}

TEST(ShippedFiles, AllParse) {
  int files = 0;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(levitas::test::SourceFolder() + "/config")) {
    if (entry.path().extension() != ".yaml") continue;
    const std::string folder = entry.path().parent_path().filename();
    const std::string path = entry.path();
    ++files;
    if (folder == "rigs") {
      EXPECT_NO_THROW((void)LoadRig(path)) << path;
    } else if (folder == "controllers") {
      EXPECT_NO_THROW((void)LoadController(path, RigOf(entry.path().stem()))) << path;
    } else {
      EXPECT_NO_THROW((void)LoadScenario(path, RigOf(entry.path().stem()))) << path;
    }
  }
  EXPECT_GE(files, 6);
}

}  // namespace
}  // namespace levitas::configuration

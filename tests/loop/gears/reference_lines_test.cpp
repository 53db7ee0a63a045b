// The geared rotor in the time domain against the steady lines of its linear model.

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

#include "plant_sim/plant/plant_model.hpp"
#include "tests/loop/gears/gear_motion.hpp"
#include "tests/support/geared_rigs.hpp"
#include "tests/support/paths.hpp"

namespace levitas::test {
namespace {

constexpr double kKp_a_per_m = 2.4e4;
constexpr double kKd_a_s_per_m = 20.0;

struct ReferenceLine {
  double speed_hz{};
  std::string name;
  double frequency_hz{};
  Whirl whirl;
};

std::vector<ReferenceLine> ReadLines() {
  std::ifstream file(test::DataFolder() + "/reference/geared_rotor_4dof_lines.csv");
  std::string line;
  std::getline(file, line);
  std::vector<ReferenceLine> lines;
  while (std::getline(file, line)) {
    std::stringstream cells(line);
    std::vector<std::string> cell;
    for (std::string text; std::getline(cells, text, ',');) cell.push_back(text);
    const auto number = [&](std::size_t i) { return std::stod(cell[i]); };
    lines.push_back(
        {number(0), cell[1], number(2), {{number(3), number(4)}, {number(5), number(6)}}});
  }
  return lines;
}

// Displacement and velocity of the discs, from the state: what an ideal sensor would tell.
struct DiscMotion {
  AxisArray position_m{};
  AxisArray velocity_m_per_s{};
};

DiscMotion Discs(const plant::Plant& plant) {
  const plant::StateLayout& at = plant.layout();
  DiscMotion motion;
  motion.position_m = plant.ActuatorPosition();
  for (std::size_t b = 0; b < 2; ++b) {
    const auto& shape = plant.model().bearings()[b].actuator_shape;
    for (std::size_t i = 0; i < at.modes; ++i) {
      motion.velocity_m_per_s[2 * b] += shape[i] * plant.state()[at.v_x + i];
      motion.velocity_m_per_s[2 * b + 1] += shape[i] * plant.state()[at.v_y + i];
    }
  }
  return motion;
}

// A loop as nearly continuous as the simulation allows: 1 us, no delay, amplifier and sensor far
// beyond every line.
constexpr std::int64_t kPeriod_ns = 1000;

plant::PlantConfig NearlyContinuous() {
  plant::PlantConfig config = GearedRotor4();
  config.period_ns = kPeriod_ns;
  config.delay_samples = 0.0;
  config.substeps = 1;
  for (auto& b : config.bearings) b.amplifier.bandwidth_hz = b.sensor.bandwidth_hz = 1e7;
  return config;
}

std::vector<Whirl> Record(double speed_hz, double settle_s, double time_s) {
  plant::Plant plant(NearlyContinuous(), 1);
  const double speed = 2.0 * std::numbers::pi * speed_hz;
  plant.SetSpeed(speed, 0.0);
  const double period_s = 1e-9 * static_cast<double>(kPeriod_ns);
  const auto settling = std::lround(settle_s / period_s);
  const auto steps = std::lround(time_s / period_s);
  std::vector<Whirl> record;
  record.reserve(static_cast<std::size_t>(steps));
  plant::PlantCommand command;
  command.bias_current_a = 1.0;
  command.drive_enabled = true;
  command.speed_set_point_rad_per_s = speed;
  // Lines are counted from the angle 0 at t = 0: whole turns of both wheels before the record.
  for (long n = 0; n < settling + steps; ++n) {
    if (n >= settling) record.push_back(At(plant));
    const DiscMotion now = Discs(plant);
    for (std::size_t axis = 0; axis < 4; ++axis) {
      // The position half a period on: the hold's own lag is taken back.
      const double ahead_m = now.position_m[axis] + 0.5 * period_s * now.velocity_m_per_s[axis];
      command.control_current_a[axis] =
          -(kKp_a_per_m * ahead_m + kKd_a_s_per_m * now.velocity_m_per_s[axis]);
    }
    plant.Advance(command);
  }
  return record;
}

TEST(ReferenceLines, OfTheFullSpectrumAreReachedWithinHalfAPercent) {
  const auto lines = ReadLines();
  ASSERT_EQ(lines.size(), 39U);
  for (const double speed_hz : {15.0, 20.0, 25.0}) {
    // Two turns of the pinion are one of the gear: all lines close in it. The slowest transient
    // falls as exp(-240 t), to 1e-9 in the turns before.
    const double repeat_s = 2.0 / speed_hz;
    const auto record = Record(speed_hz, repeat_s, repeat_s);
    for (const ReferenceLine& line : lines) {
      if (line.speed_hz != speed_hz) continue;
      const Whirl found = Line(record, 1e-6, line.frequency_hz);
      EXPECT_LT(std::abs(found.pinion - line.whirl.pinion), 0.005 * std::abs(line.whirl.pinion))
          << speed_hz << " Hz, " << line.name;
      EXPECT_LT(std::abs(found.gear - line.whirl.gear), 0.005 * std::abs(line.whirl.gear))
          << speed_hz << " Hz, " << line.name;
    }
  }
}

// Where the pinion comes to rest without rotation, the transmission error standing still.
Complex Rest(double stiffness_ratio) {
  plant::PlantConfig config = NearlyContinuous();
  config.gears[0].stiffness_n_per_m *= stiffness_ratio;
  plant::Plant plant(config, 1);
  plant::PlantCommand command;
  command.bias_current_a = 1.0;
  for (int n = 0; n < 60'000; ++n) {
    const DiscMotion now = Discs(plant);
    for (std::size_t axis = 0; axis < 4; ++axis) {
      command.control_current_a[axis] =
          -(kKp_a_per_m * now.position_m[axis] + kKd_a_s_per_m * now.velocity_m_per_s[axis]);
    }
    plant.Advance(command);
  }
  return At(plant).pinion;
}

TEST(ReferenceLines, WouldShowAMeshTwoPercentTooStiff) {
  // The other half of the pair: half a percent is narrow enough to notice a wrong parameter.
  EXPECT_GT(std::abs(Rest(1.02) - Rest(1.0)), 0.005 * std::abs(Rest(1.0)));
}

}  // namespace
}  // namespace levitas::test

// Rigs drawn within a file's tolerances.
#include "design/drawn_rigs/healthy_rig.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "plant_sim/plant/plant_model.hpp"
#include "tests/support/paths.hpp"

namespace levitas::uncertainty {
namespace {

configuration::RigFile Shipped(const std::string& name) {
  return configuration::LoadRig(test::SourceFolder() + "/config/rigs/" + name + ".yaml");
}

TEST(DrawWithin, ScattersByTheStatedDeviationAndNotBeyondThreeOfThem) {
  configuration::RigFile rig = Shipped("flexible_rotor");
  rig.tolerances->sensor_gain = 0.02;
  Random draw(5);
  double squares = 0.0;
  constexpr int kRigs = 400;
  for (int n = 0; n < kRigs; ++n) {
    const double off = DrawWithin(rig, draw).plant.bearings[0].sensor.gain - 1.0;
    EXPECT_LE(std::abs(off), 3.0 * 0.02 + 1e-12);
    squares += off * off;
  }
  // A variance of 400 draws is known to 7 %.
  EXPECT_NEAR(std::sqrt(squares / kRigs), 0.02, 0.004);
}

TEST(DrawWithin, ChangesNothingWhereNothingIsTolerated) {
  configuration::RigFile rig = Shipped("flexible_rotor");
  rig.tolerances = configuration::Tolerances{};
  auto& t = *rig.tolerances;
  t.amplifier_bandwidth = t.sensor_gain = t.sensor_bandwidth = t.sensor_offset_m = 0.0;
  t.sensor_position_m = t.sensor_runout_m = t.delay_samples = t.rotor_mass = 0.0;
  t.gyroscopic_inertia = t.unbalance_kg_m = t.static_load_n = 0.0;
  Random draw(5);
  const configuration::RigFile same = DrawWithin(rig, draw);
  EXPECT_EQ(same.plant.delay_samples, rig.plant.delay_samples);
  for (const auto& entry : same.plant.effects) {
    const bool ratio =
        entry.id == effect::Id::kRotorMass || entry.id == effect::Id::kGyroscopicInertia;
    if (ratio) {
      EXPECT_EQ(entry.values[0], 1.0);
    }
    if (entry.id == effect::Id::kSensorOffset) {
      EXPECT_EQ(entry.values[0], 0.0);
    }
  }
}

TEST(DrawWithin, IsARigThatCanBeSimulatedAndWrittenForEveryShippedOne) {
  for (const char* name : {"flexible_rotor", "turbomolecular_pump", "geared_rotor_4dof",
                           "geared_rotor_8dof", "geared_rotor_12dof"}) {
    const configuration::RigFile rig = Shipped(name);
    Random draw(11);
    const configuration::RigFile drawn = DrawWithin(rig, draw);
    EXPECT_NO_THROW(plant::PlantModel{drawn.plant}) << name;
    EXPECT_NO_THROW((void)configuration::ParseRig(configuration::WriteRig(drawn), name)) << name;
  }
}

}  // namespace
}  // namespace levitas::uncertainty

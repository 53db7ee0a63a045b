// Geared rigs as files: the shipped ones hold the numbers of their sources, bad ones are refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <numbers>
#include <sstream>

#include "common/problem.hpp"
#include "configuration/rig_file.hpp"

namespace levitas::configuration {
namespace {

using testing::HasSubstr;

std::string ShippedText(const std::string& name) {
  std::ifstream file(FindConfig(name, "rigs"));
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// The shipped text with one piece replaced.
std::string With(const std::string& name, const std::string& from, const std::string& to) {
  std::string text = ShippedText(name);
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string Refusal(const std::string& text) {
  try {
    (void)ParseRig(text, "rig.yaml");
  } catch (const BadInput& problem) {
    return problem.what();
  }
  return "accepted";
}

TEST(GearedRotor4, HasTheNumbersOfItsSource) {
  const RigFile rig = LoadRig(FindConfig("geared_rotor_4dof", "rigs"));
  EXPECT_EQ(rig.numbers.channels, (std::vector<std::string>{"p_x", "p_y", "g_x", "g_y"}));
  ASSERT_EQ(rig.plant.shafts.size(), 2U);
  EXPECT_EQ(rig.plant.shafts[0].lumped.mass_kg, 2.0);
  EXPECT_EQ(rig.plant.shafts[1].lumped.kll_n_per_m, 2.4e5);
  EXPECT_FALSE(rig.plant.shafts[0].lumped.tilts);
  ASSERT_EQ(rig.plant.gears.size(), 1U);
  const gear::GearPair& pair = rig.plant.gears[0];
  EXPECT_EQ(pair.driving.teeth, 20);
  EXPECT_EQ(pair.driven.teeth, 40);
  EXPECT_EQ(pair.driven.shaft, 1U);
  EXPECT_EQ(pair.driven.runout_m, 30e-6);
  EXPECT_EQ(pair.driven.runout_phase_rad, 0.9);
  EXPECT_EQ(pair.direction, gear::Direction::kIsotropic);
  ASSERT_EQ(pair.transmission_error.size(), 11U);
  EXPECT_EQ(pair.transmission_error[10].order, -5);
  EXPECT_EQ(pair.transmission_error[10].phase_rad, -0.4);
  EXPECT_EQ(rig.plant.bearings[1].shaft, 1U);
  const plant::MagnetConfig& m = rig.plant.bearings[0].magnet;
  EXPECT_NEAR(4.0 * m.force_constant_n_m2_per_a2 / (m.gap_m * m.gap_m), 80.0, 1e-9);
  EXPECT_EQ(rig.numbers.clearance_m, 400e-6);
  EXPECT_EQ(rig.run.controller, "geared_rotor");
}

TEST(GearedRotor12, HasTorsionFromMotorToBrake) {
  const RigFile rig = LoadRig(FindConfig("geared_rotor_12dof", "rigs"));
  const rotor::Torsion& first = rig.plant.shafts[0].torsion;
  const rotor::Torsion& second = rig.plant.shafts[1].torsion;
  ASSERT_EQ(first.inertias.size(), 2U);
  EXPECT_EQ(first.inertias[0].inertia_kg_m2, 5.0e-3);
  EXPECT_EQ(first.inertias[0].stiffness_n_m_per_rad, 1830.0);
  EXPECT_EQ(first.gear_at, 1U);
  EXPECT_EQ(second.gear_at, 0U);
  EXPECT_EQ(second.inertias[1].inertia_kg_m2, 8.0e-3);
  EXPECT_EQ(rig.plant.gears[0].driving_torque_n_m, 5.0);
  EXPECT_EQ(rig.plant.gears[0].driving.base_radius_m, 37.6e-3);
}

TEST(GearedRigs, ReadBackWhatIsWritten) {
  for (const char* name :
       {"geared_rotor_4dof", "geared_rotor_8dof", "geared_rotor_12dof", "rao_geared_pair"}) {
    const std::string written = WriteRig(LoadRig(FindConfig(name, "rigs")));
    EXPECT_EQ(WriteRig(ParseRig(written, "again")), written) << name;
  }
}

TEST(GearedRigs, NeedAGearToEveryShaft) {
  EXPECT_THAT(Refusal(With("geared_rotor_4dof", "shaft: 2\n      teeth", "shaft: 1\n      teeth")),
              HasSubstr("must be on another shaft"));
  EXPECT_THAT(Refusal(With("geared_rotor_4dof", "shaft: 2\n      teeth", "shaft: 3\n      teeth")),
              HasSubstr("found 3, but the rig has 2 shafts"));
}

TEST(GearedRigs, HaveEitherARotorOrShafts) {
  const std::string both = With("geared_rotor_4dof", "gears:\n",
                                "rotor:\n"
                                "  material: {young_gpa: 193, poisson: 0.29, density_kg_per_m3: "
                                "7930}\n"
                                "  sections: [{length_mm: 100, outer_diameter_mm: 10}]\n"
                                "  discs: []\n"
                                "gears:\n");
  EXPECT_THAT(Refusal(both), HasSubstr("give either rotor or shafts"));
}

TEST(GearedRigs, HaveNoWeight) {
  EXPECT_THAT(Refusal(With("geared_rotor_4dof", "acceleration_m_per_s2: 0 ",
                           "acceleration_m_per_s2: 9.81 ")),
              HasSubstr("must be 0 with shafts"));
}

TEST(GearedRigs, NameTheWheelWhoseCouplingIsMisaligned) {
  const auto rig = [](const std::string& entry) {
    return ShippedText("geared_rotor_12dof") + "effects:\n  - {id: misalignment, " + entry + "}\n";
  };
  const RigFile read = ParseRig(
      rig("gear: mesh, wheel: driven, order: 1, rotation_error_rad: 3e-4, phase_deg: 90"), "rig");
  ASSERT_EQ(read.plant.effects.size(), 1U);
  EXPECT_TRUE(read.plant.effects[0].on_driven);
  EXPECT_DOUBLE_EQ(read.plant.effects[0].values[4], 3e-4);
  EXPECT_EQ(WriteRig(ParseRig(WriteRig(read), "again")), WriteRig(read));
  EXPECT_THAT(Refusal(rig("force_n: 1")), HasSubstr("gear"));
  EXPECT_THAT(Refusal(rig("gear: mesh, wheel: driven, force_n: 1")),
              HasSubstr("z_mm = 0, but shaft gear can be pushed at its disc only, at 200"));
  EXPECT_THAT(Refusal(rig("gear: mesh, wheel: driven")), HasSubstr("neither force_n nor"));
}

TEST(LumpedShafts, HaveOnePlaneAndOneWayToGiveTheirStiffness) {
  EXPECT_THAT(Refusal(With("geared_rotor_8dof", "actuator_z_mm: 200", "actuator_z_mm: 210")),
              HasSubstr("a lumped shaft has one plane, that of its disc at 200 mm"));
  EXPECT_THAT(Refusal(With("geared_rotor_8dof", "span_mm: 500", "span_mm: 150")),
              HasSubstr("between the ends of the span"));
  EXPECT_THAT(Refusal(With("geared_rotor_8dof", "span_mm: 500",
                           "stiffness_n_per_m: 2e5\n      span_mm: 500")),
              HasSubstr("the stiffness of the shaft at its disc"));
  EXPECT_THAT(Refusal(With("geared_rotor_8dof", "polar_inertia_kg_m2: 3.4e-3",
                           "polar_inertia_kg_m2: 3.7e-3")),
              HasSubstr("no body has Ip greater than 2 Id"));
}

TEST(Torsion, NamesAnInertiaThatExists) {
  EXPECT_THAT(Refusal(With("geared_rotor_12dof", "gear_at: 2", "gear_at: 3")),
              HasSubstr("found 3, but there are 2 inertias"));
  EXPECT_THAT(Refusal(With("geared_rotor_12dof", "kind: inertias", "kind: beam")),
              HasSubstr("for a shaft described as a beam"));
}

}  // namespace
}  // namespace levitas::configuration

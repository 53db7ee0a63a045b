// The effects of a rig file: what is read, and what is said of what cannot be.
#include <gtest/gtest.h>

#include <stdexcept>

#include "plant_sim/effect/catalogue.hpp"
#include "plant_sim/plant/check_config.hpp"
#include "tests/unit/configuration/full_samples.hpp"
#include "tests/unit/configuration/samples.hpp"

namespace levitas::configuration::test {
namespace {

/// The small rig (one bearing, de; shaft of 200 mm; default modes) with a list of effects.
std::string RigWith(const std::string& effects) {
  return std::string(kRig) + "effects:\n" + effects;
}

std::vector<effect::EffectConfig> Read(const std::string& effects) {
  return ParseRig(RigWith(effects), "rig.yaml").plant.effects;
}

TEST(Effects, OfAFileKeepOrderUnitsAndPlaces) {
  const auto read = Read(R"(
  - {id: eddy_current, channels: [de_y], tau_us: 80}
  - {id: support_mode, bearing: de, mass_kg: 4, frequency_hz: 150, strength: 0.5}
  - {id: misalignment, order: -3, force_n: 2, phase_deg: 90, at_s: 1.5, ramp_s: 2}
)");
  ASSERT_EQ(read.size(), 3U);
  EXPECT_EQ(read[0].id, effect::Id::kEddyCurrent);
  EXPECT_EQ(read[0].axes, 0b10U);
  EXPECT_EQ(read[0].values[0], 80e-6);
  EXPECT_EQ(read[1].bearing, 0U);
  EXPECT_EQ(read[1].values[2], 0.02);  // the default damping ratio
  EXPECT_EQ(read[1].strength, 0.5);
  EXPECT_EQ(read[2].values[1], -3.0);
  EXPECT_DOUBLE_EQ(read[2].values[3], 1.5707963267948966);
  EXPECT_EQ(read[2].at_s, 1.5);
  EXPECT_EQ(read[2].ramp_s, 2.0);
}

TEST(Effects, WithoutChannelsOrWithAllOfThemActOnEveryAxis) {
  EXPECT_EQ(Read("  - {id: current_gain, ratio: 0.9}\n")[0].axes, effect::kAllAxes);
  EXPECT_EQ(Read("  - {id: current_gain, channels: [de_y, de_x], ratio: 0.9}\n")[0].axes,
            effect::kAllAxes);
}

TEST(Effects, MayBeLeftOut) {
  EXPECT_TRUE(ParseRig(kRig, "rig.yaml").plant.effects.empty());
  EXPECT_NE(WriteRig(ParseRig(kRig, "rig.yaml")).find("effects: []\n"), std::string::npos);
}

TEST(Effects, OfEveryIdAreWrittenAndReadBackTheSame) {
  const RigFile gears = AllEffects(true);
  const RigFile one_rotor = AllEffects();
  ASSERT_EQ(one_rotor.plant.effects.size() + gears.plant.effects.size(),
            effect::EntryRows().size());
  for (const RigFile& rig : {one_rotor, gears}) {
    const auto back = ParseRig(WriteRig(rig), "written.yaml").plant.effects;
    ASSERT_EQ(back.size(), rig.plant.effects.size());
    for (std::size_t i = 0; i < back.size(); ++i) {
      const effect::Row& row = effect::At(back[i].id);
      EXPECT_EQ(back[i].id, rig.plant.effects[i].id);
      EXPECT_EQ(back[i].axes, rig.plant.effects[i].axes) << row.name;
      EXPECT_EQ(back[i].mode, rig.plant.effects[i].mode) << row.name;
      for (std::size_t k = 0; k < row.parameters.size(); ++k) {
        EXPECT_EQ(back[i].values[k], rig.plant.effects[i].values[k])
            << row.name << "." << row.parameters[k].stem;
      }
    }
  }
}

// A rig that no file describes meets the same refusal.
TEST(Effects, OfCoilsOnAVoltageAreRefusedInAPlantAsInAFile) {
  RigFile rig = ParseRig(kRig, "rig.yaml");
  rig.plant.effects = {effect::ClearEntry(effect::Id::kCoilInductance)};
  try {
    plant::CheckEffects(rig.plant);
    ADD_FAILURE() << "taken";
  } catch (const std::invalid_argument& refused) {
    EXPECT_STREQ(refused.what(),
                 "effects[0] (coil_inductance): coils on a voltage have it by keys of their own; "
                 "write time_constant_ms and away_time_constant_ratio of amplifier.voltage "
                 "instead, and leave it out for other "
                 "coils; correct the rig description");
  }
}

struct Refused {
  const char* effects;
  const char* said;
};

TEST(Effects, ThatCannotBeAreRefusedWithWhatIsAllowed) {
  for (const auto& [effects, said] : {
           Refused{"  - {id: eddy_curent, tau_us: 8}\n", "nearest eddy_current"},
           Refused{"  - {tau_us: 8}\n", "which effect"},
           Refused{"  - {id: supply_voltage, ratio: 1.1}\n",
                   "found supply_voltage; coils on a voltage have it by keys of their own; write "
                   "steady of amplifier.voltage instead"},
           Refused{"  - {id: dry_friction, force_n: 1}\n",
                   "found dry_friction; no simulated rig has it; leave it out"},
           Refused{"  - {id: eddy_current}\n", "tau_us: missing"},
           Refused{"  - {id: eddy_current, tau_us: -1}\n", "found -1 us, allowed 0 to 100000 us"},
           Refused{"  - {id: eddy_current, tau_us: 8, width_a: 1}\n", "width_a"},
           Refused{"  - {id: eddy_current, channels: [nde_x], tau_us: 8}\n", "nearest de_x"},
           Refused{"  - {id: eddy_current, channels: de_x, tau_us: 8}\n", "must be such a list"},
           Refused{"  - {id: eddy_current, channels: [de_x, de_x], tau_us: 8}\n", "given twice"},
           Refused{"  - {id: eddy_current, channels: [], tau_us: 8}\n", "must be such a list"},
           Refused{"  - {id: sensor_position, bearing: nde, shift_mm: 1}\n", "allowed de"},
           Refused{"  - {id: sensor_position, bearing: de, shift_mm: 95}\n", "end of the shaft"},
           Refused{"  - {id: unbalance, z_mm: 300, moment_g_mm: 5}\n", "end of the shaft"},
           Refused{"  - {id: modal_damping, mode: 7, damping_ratio: 0.1}\n", "6 flexible modes"},
           Refused{"  - {id: tooth_crack, gear: <gear>, wheel: driven, depth: 0.5}\n",
                   "needs a rig with gears"},
           Refused{"  - {id: misalignment, order: 1.5, force_n: 1}\n", "not a whole number"},
           Refused{"  - {id: misalignment, rotation_error_deg: 0.1}\n", "between geared shafts"},
           Refused{"  - {id: axis_rotation, bearing: de, angle_deg: 5}\n", "what is turned"},
           Refused{"  - {id: eddy_current, tau_us: 8}\n  - {id: eddy_current, tau_us: 9}\n",
                   "acts at the same place"},
           Refused{"  - {id: eddy_current, tau_us: 8, strength: 1.2}\n", "allowed 0 to 1"},
       }) {
    const std::string found = RigProblems(RigWith(effects));
    EXPECT_NE(found.find(said), std::string::npos) << effects << found;
  }
}

TEST(Effects, OfAnUnknownIdAreOneProblemNotOnePerKey) {
  const std::string found =
      RigProblems(RigWith("  - {id: nonsense, tau_us: 8, width_a: 1, order: 2}\n"));
  EXPECT_EQ(found.find("problems in"), std::string::npos) << found;
}

}  // namespace
}  // namespace levitas::configuration::test

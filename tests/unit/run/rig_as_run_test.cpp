#include "cli/run/rig_as_run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "common/problem.hpp"
#include "plant_sim/magnet/magnet.hpp"
#include "plant_sim/plant/magnet_of.hpp"
#include "tests/support/scratch_folder.hpp"

namespace levitas::cli {
namespace {

using testing::HasSubstr;

std::string ShippedRig() { return configuration::FindConfig("flexible_rotor", "rigs"); }

double ForcePerAmpere(const configuration::RigFile& rig) {
  const auto& magnet = rig.plant.bearings.front().magnet;
  return magnet::ForcePerCurrent(plant::MagnetOf(magnet), magnet.bias_current_a);
}

double StiffnessOf(const configuration::RigFile& rig) {
  const auto& magnet = rig.plant.bearings.front().magnet;
  return magnet::NegativeStiffness(plant::MagnetOf(magnet), magnet.bias_current_a);
}

TEST(RigAsRun, IsTheFilesWithoutABiasCurrentOfItsOwn) {
  const configuration::RigFile file = configuration::LoadRig(ShippedRig());
  const RigAsRun as_run = ReadRigAsRun(ShippedRig(), {});
  EXPECT_EQ(as_run.text, configuration::WriteRig(file));
  EXPECT_EQ(as_run.rig.numbers.bias_current_a, file.numbers.bias_current_a);
}

TEST(RigAsRun, KeepsTheMagnetsSoThatTheirForceGrowsWithTheBias) {
  const configuration::RigFile file = configuration::LoadRig(ShippedRig());
  const RigAsRun as_run =
      ReadRigAsRun(ShippedRig(), {.bias_current_a = 0.8 * file.numbers.bias_current_a});
  EXPECT_NEAR(ForcePerAmpere(as_run.rig) / ForcePerAmpere(file), 0.8, 1e-12);  // ki ~ i0
  EXPECT_NEAR(StiffnessOf(as_run.rig) / StiffnessOf(file), 0.8 * 0.8, 1e-12);  // ks ~ i0^2
}

TEST(RigAsRun, IsInItsTextAsItIs) {
  const RigAsRun as_run = ReadRigAsRun(ShippedRig(), {.bias_current_a = 0.8});
  const configuration::RigFile read = configuration::ParseRig(as_run.text, "text");
  EXPECT_EQ(read.numbers.bias_current_a, 0.8);
  for (const auto& bearing : read.plant.bearings) EXPECT_EQ(bearing.magnet.bias_current_a, 0.8);
}

TEST(RigAsRun, RefusesWhatNoRigFileMayHaveAndNamesTheOption) {
  for (const double bias_a : {-1.0, 0.0, 1e6, 50.0}) {  // 50 A: beyond the coils' largest current
    try {
      static_cast<void>(ReadRigAsRun(ShippedRig(), {.bias_current_a = bias_a}));
      ADD_FAILURE() << bias_a << " A was taken";
    } catch (const BadInput& refused) {
      EXPECT_THAT(refused.what(), HasSubstr("--bias-current-a"));
      EXPECT_THAT(refused.what(), HasSubstr("coils."));
    }
  }
}

TEST(RigAsRun, AddsEffectsBehindThoseOfTheFile) {
  const RigAsRun as_run = ReadRigAsRun(
      ShippedRig(), {.effects = {"{id: coupling_stiffness, direct_n_per_m: 0, cross_n_per_m: 5e4}",
                                 "- id: misalignment, force_n: 0.4, order: -3"}});
  const auto read = configuration::ParseRig(as_run.text, "text").plant.effects;
  ASSERT_EQ(read.size(), configuration::LoadRig(ShippedRig()).plant.effects.size() + 2);
  EXPECT_EQ(read[read.size() - 2].id, effect::Id::kCouplingStiffness);
  EXPECT_EQ(read.back().id, effect::Id::kMisalignment);
  EXPECT_EQ(as_run.rig.plant.effects.size(), read.size());
}

TEST(RigAsRun, RefusesAnEntryThatNoRigFileMayHaveAndNamesIt) {
  for (const std::string entry :
       {"{id: misalinment, force_n: 1}", "{id: misalignment, force_kg: 1}", "misalignment", "",
        "{id: support_mode, bearing: middle, mass_kg: 8, frequency_hz: 400}", "{id: backlash",
        "{id: misalignment}]\nname: other\nkind: [x"}) {
    try {
      static_cast<void>(ReadRigAsRun(ShippedRig(), {.effects = {entry}}));
      ADD_FAILURE() << entry << " was taken";
    } catch (const BadInput& refused) {
      EXPECT_THAT(refused.what(), HasSubstr("--effect '" + entry + "'"));
    }
  }
}

/// The shipped rig with effects of its own, as a file.
std::string WithItsOwnEffects(const test::ScratchFolder& folder) {
  std::string text = configuration::WriteRig(configuration::LoadRig(ShippedRig()));
  const std::string none = "\neffects: []\n";
  const auto at = text.find(none);
  EXPECT_NE(at, std::string::npos);
  text.replace(at, none.size(),
               "\neffects:\n"
               "  - {id: misalignment, force_n: 2, order: 1, phase_deg: 90}\n"
               "  - {id: gyroscopic_inertia, ratio: 1.2, strength: 0.5, at_s: 2}\n");
  std::ofstream(folder / "own.yaml") << text;
  return folder / "own.yaml";
}

// One flow entry or several lines, each once: the file's come first and stay as they are.
TEST(RigAsRun, KeepsTheEffectsOfTheFileBeforeThoseAdded) {
  const test::ScratchFolder folder;
  const std::string path = WithItsOwnEffects(folder);
  const configuration::RigFile file = configuration::LoadRig(path);
  ASSERT_EQ(file.plant.effects.size(), 2U);
  const RigAsRun as_run =
      ReadRigAsRun(path, {.effects = {"id: misalignment, force_n: 4, order: 3",
                                      "{id: rotor_mass, ratio: 1.1, strength: 0.25, ramp_s: 3}",
                                      "- {id: misalignment, force_n: 1, order: -2}"}});
  const auto& effects = as_run.rig.plant.effects;
  ASSERT_EQ(effects.size(), 5U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(effects[i].id, file.plant.effects[i].id);
    EXPECT_EQ(effects[i].values, file.plant.effects[i].values);
    EXPECT_EQ(effects[i].strength, file.plant.effects[i].strength);
    EXPECT_EQ(effects[i].at_s, file.plant.effects[i].at_s);
  }
  EXPECT_EQ(effects[2].values[1], 3.0);  // order
  EXPECT_EQ(effects[2].values[2], 4.0);
  EXPECT_EQ(effects[3].id, effect::Id::kRotorMass);
  EXPECT_EQ(effects[3].strength, 0.25);
  EXPECT_EQ(effects[3].ramp_s, 3.0);
  EXPECT_EQ(effects[4].values[1], -2.0);
}

// Taken out again, the text is the file's own.
TEST(RigAsRun, ChangesNothingButTheEffects) {
  const test::ScratchFolder folder;
  const std::string path = WithItsOwnEffects(folder);
  configuration::RigFile as_run =
      ReadRigAsRun(path, {.effects = {"id: extra_delay, delay_us: 20"}}).rig;
  ASSERT_EQ(as_run.plant.effects.size(), 3U);
  as_run.plant.effects.pop_back();
  EXPECT_EQ(configuration::WriteRig(as_run), configuration::WriteRig(configuration::LoadRig(path)));
  const RigAsRun both =
      ReadRigAsRun(path, {.bias_current_a = 0.8, .effects = {"id: extra_delay, delay_us: 20"}});
  EXPECT_EQ(both.rig.numbers.bias_current_a, 0.8);
  EXPECT_EQ(both.rig.plant.effects.size(), 3U);
}

// What acts at one place can be there once: twice among the options, or there and in the file.
TEST(RigAsRun, RefusesASecondEntryAtTheSamePlaceAndNamesTheOption) {
  const test::ScratchFolder folder;
  const std::string path = WithItsOwnEffects(folder);
  const std::string inertia = "id: gyroscopic_inertia, ratio: 1.1";
  const std::string delay = "id: extra_delay, delay_us: 20";
  for (const auto& entries : {std::vector{inertia}, std::vector{delay, delay}}) {
    try {
      static_cast<void>(ReadRigAsRun(path, {.effects = entries}));
      ADD_FAILURE() << entries.front() << " was taken twice";
    } catch (const BadInput& refused) {
      EXPECT_THAT(refused.what(), HasSubstr("--effect"));
      EXPECT_THAT(refused.what(), HasSubstr("acts at the same place"));
      EXPECT_THAT(refused.what(),
                  HasSubstr(entries.size() == 1 ? "gyroscopic_inertia" : "extra_delay"));
    }
  }
  // Couplings add up.
  const std::string coupling = "id: misalignment, force_n: 1";
  EXPECT_EQ(ReadRigAsRun(path, {.effects = {coupling, coupling}}).rig.plant.effects.size(), 4U);
}

// The message leads to the entry that is wrong, not to its neighbours.
TEST(RigAsRun, NamesTheEntryWithAnUnknownKeyAmongSeveral) {
  const std::string wrong = "id: misalignment, force_n: 1, colour: red";
  try {
    static_cast<void>(ReadRigAsRun(
        ShippedRig(), {.effects = {"id: misalignment, force_n: 2", wrong, "id: no_such_effect"}}));
    ADD_FAILURE() << "taken";
  } catch (const BadInput& refused) {
    EXPECT_THAT(refused.what(), HasSubstr("--effect '" + wrong + "'"));
    EXPECT_THAT(refused.what(), HasSubstr("colour"));
    EXPECT_THAT(refused.what(), testing::Not(HasSubstr("no_such_effect")));
  }
}

}  // namespace
}  // namespace levitas::cli

#include "cli/run/rig_as_run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/problem.hpp"
#include "plant_sim/magnet/magnet.hpp"
#include "plant_sim/plant/magnet_of.hpp"

namespace levitas::cli {
namespace {

using testing::HasSubstr;

std::string ShippedRig() { return config::FindConfig("flexible_rotor", "rigs"); }

double ForcePerAmpere(const config::RigFile& rig) {
  const auto& magnet = rig.plant.bearings.front().magnet;
  return magnet::ForcePerCurrent(plant::MagnetOf(magnet), magnet.bias_current_a);
}

double StiffnessOf(const config::RigFile& rig) {
  const auto& magnet = rig.plant.bearings.front().magnet;
  return magnet::NegativeStiffness(plant::MagnetOf(magnet), magnet.bias_current_a);
}

TEST(RigAsRun, IsTheFilesWithoutABiasCurrentOfItsOwn) {
  const config::RigFile file = config::LoadRig(ShippedRig());
  const RigAsRun as_run = ReadRigAsRun(ShippedRig(), {});
  EXPECT_EQ(as_run.text, config::WriteRig(file));
  EXPECT_EQ(as_run.rig.numbers.bias_current_a, file.numbers.bias_current_a);
}

TEST(RigAsRun, KeepsTheMagnetsSoThatTheirForceGrowsWithTheBias) {
  const config::RigFile file = config::LoadRig(ShippedRig());
  const RigAsRun as_run =
      ReadRigAsRun(ShippedRig(), {.bias_current_a = 0.8 * file.numbers.bias_current_a});
  EXPECT_NEAR(ForcePerAmpere(as_run.rig) / ForcePerAmpere(file), 0.8, 1e-12);  // ki ~ i0
  EXPECT_NEAR(StiffnessOf(as_run.rig) / StiffnessOf(file), 0.8 * 0.8, 1e-12);  // ks ~ i0^2
}

TEST(RigAsRun, IsInItsTextAsItIs) {
  const RigAsRun as_run = ReadRigAsRun(ShippedRig(), {.bias_current_a = 0.8});
  const config::RigFile read = config::ParseRig(as_run.text, "text");
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
  const auto read = config::ParseRig(as_run.text, "text").plant.effects;
  ASSERT_EQ(read.size(), config::LoadRig(ShippedRig()).plant.effects.size() + 2);
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

}  // namespace
}  // namespace levitas::cli

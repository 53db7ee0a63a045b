// By how much a rig may differ, from its three sources.
#include "design/drawn_rigs/rig_uncertainty.hpp"

#include <gmock/gmock.h>

#include "common/problem.hpp"
#include "plant_sim/plant/plant_model.hpp"
#include "tests/support/paths.hpp"

namespace levitas::uncertainty {
namespace {

const configuration::RigFile& FlexibleRotor() {
  static const configuration::RigFile rig =
      configuration::LoadRig(test::SourceFolder() + "/config/rigs/flexible_rotor.yaml");
  return rig;
}

std::vector<Parameter> Of(Kind kind, const std::vector<Parameter>& all) {
  std::vector<Parameter> out;
  for (const Parameter& parameter : all)
    if (parameter.kind == kind) out.push_back(parameter);
  return out;
}

IdentifiedDeviations Found() {
  return {{0.1, 0.2}, {0.05, 0.5}, {0.01, 0.02, 0.03, 0.04}, {0.02, 0.02, 0.02, 0.002}};
}

TEST(RigUncertainty, OfAnIdentificationIsThreeOfItsDeviationsAboutTheFile) {
  const auto all = FromIdentification(FlexibleRotor(), Found());
  const auto frequency = Of(Kind::kModeFrequency, all);
  ASSERT_EQ(frequency.size(), 2U);  // of the modes that were found, not of all of the file
  EXPECT_NEAR(frequency[0].size(), 0.3, 1e-9);
  EXPECT_NEAR(frequency[1].size(), 0.6, 1e-9);
  EXPECT_NEAR(frequency[0].nominal, 0.5 * (frequency[0].low + frequency[0].high), 1e-9);
  const auto damping = Of(Kind::kModeDamping, all);
  EXPECT_NEAR(damping[0].size(), 0.15 * damping[0].nominal, 1e-12);
  // Known to half of itself, three deviations would be negative: damping stays damping.
  EXPECT_GT(damping[1].low, 0.0);
  const auto gain = Of(Kind::kCurrentGain, all);
  const auto stiffness = Of(Kind::kStiffness, all);
  ASSERT_EQ(gain.size(), 4U);
  for (std::size_t axis = 0; axis < 4; ++axis) {
    EXPECT_NEAR(gain[axis].size(), 3.0 * Found().current_gain[axis], 1e-12);
    EXPECT_NEAR(stiffness[axis].size(), 3.0 * Found().stiffness[axis], 1e-12);
  }
}

TEST(RigUncertainty, OfAnIdentificationOfAnotherRigIsRefused) {
  IdentifiedDeviations two_axes = Found();
  two_axes.current_gain.resize(2);
  two_axes.stiffness.resize(2);
  try {
    (void)FromIdentification(FlexibleRotor(), two_axes);
    FAIL() << "accepted";
  } catch (const BadInput& problem) {
    EXPECT_THAT(problem.what(), testing::HasSubstr("of 2 axes, rig flexible_rotor has 4"));
  }
}

TEST(RigUncertainty, StatedIsTheSameForEveryModeAndAxis) {
  const auto all = Stated(FlexibleRotor(), {.mode_hz = 1.5, .current_gain = 0.04, .modes = 3});
  ASSERT_EQ(Of(Kind::kModeFrequency, all).size(), 3U);
  for (const Parameter& mode : Of(Kind::kModeFrequency, all)) EXPECT_NEAR(mode.size(), 1.5, 1e-9);
  for (const Parameter& gain : Of(Kind::kCurrentGain, all)) EXPECT_NEAR(gain.size(), 0.04, 1e-12);
}

// A file with entries of its own, as an identification writes it: one axis is weak, all are stiff.
TEST(RigUncertainty, DrawsAboutTheEntriesThatTheFileHas) {
  configuration::RigFile rig = FlexibleRotor();
  const auto add = [&](effect::Id id, std::uint32_t axes, double value) {
    effect::EffectConfig entry;
    entry.id = id;
    entry.axes = axes;
    entry.values[0] = value;
    rig.plant.effects.push_back(entry);
  };
  add(effect::Id::kCurrentGain, 1U, 0.9);
  add(effect::Id::kDisplacementStiffness, effect::kAllAxes, 1.2);
  const auto parameters = Stated(rig, {.current_gain = 0.05, .stiffness = 0.1});
  const std::vector<double> highest(parameters.size(), 1.0);
  const configuration::RigFile drawn = At(rig, parameters, highest);
  EXPECT_NO_THROW(plant::PlantModel{drawn.plant});
  const auto share = [&](effect::Id id, std::size_t axis) {
    double product = 1.0;
    for (const auto& entry : drawn.plant.effects)
      if (entry.id == id && entry.Acts(axis)) product *= entry.values[0];
    return product;
  };
  EXPECT_NEAR(share(effect::Id::kCurrentGain, 0), 0.9 * 1.05, 1e-12);
  EXPECT_NEAR(share(effect::Id::kCurrentGain, 1), 1.05, 1e-12);
  for (std::size_t axis = 0; axis < 4; ++axis)
    EXPECT_NEAR(share(effect::Id::kDisplacementStiffness, axis), 1.2 * 1.1, 1e-12);
}

TEST(RigUncertainty, DrawsTheModeInPlaceOfTheFilesEntry) {
  configuration::RigFile rig = FlexibleRotor();
  effect::EffectConfig entry;
  entry.id = effect::Id::kModalFrequency;
  entry.mode = 2;
  entry.values[0] = 260.0;
  rig.plant.effects.push_back(entry);
  const auto parameters = Stated(rig, {.mode_hz = 2.0});
  const configuration::RigFile drawn =
      At(rig, parameters, std::vector<double>(parameters.size(), 0.5));
  EXPECT_NO_THROW(plant::PlantModel{drawn.plant});
  const auto moved = Of(Kind::kModeFrequency, parameters)[1];
  EXPECT_NEAR(moved.nominal, 260.0, 1e-9);
  for (const auto& found : drawn.plant.effects)
    if (found.id == effect::Id::kModalFrequency && found.mode == 2) {
      EXPECT_NEAR(found.values[0], 261.0, 1e-9);
    }
}

}  // namespace
}  // namespace levitas::uncertainty

// From the entries of a geared rig to its teeth: each entry does what its row of the catalogue
// says, and strength 0 is the nominal gear, bit for bit.

#include "plant_sim/plant/applied_effects/gear_effects.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "plant_sim/plant/plant_model.hpp"
#include "tests/support/effect_entry.hpp"
#include "tests/support/geared_rigs.hpp"

namespace levitas::plant {
namespace {

using effect::EffectConfig;
using effect::Id;

EffectConfig OnDriven(EffectConfig entry) {
  entry.on_driven = true;
  return entry;
}

/// The train of a rig with these entries, at one strength of all.
TrainModel TrainAt(double strength, const std::vector<EffectConfig>& entries) {
  PlantConfig config = test::GearedRotor4();
  config.effects = entries;
  PlantModel model(config);
  const std::vector<double> strengths(entries.size(), strength);
  model.SetStrengths(strengths);
  return model.train();
}
const TrainModel& Nominal() {
  static const TrainModel train = PlantModel(test::GearedRotor4()).train();
  return train;
}

void ExpectTheSame(const TrainModel& one, const TrainModel& other) {
  const gear::MeshLaw& law = one.meshes[0].law;
  const gear::MeshLaw& same = other.meshes[0].law;
  EXPECT_EQ(law.stiffness_n_per_m, same.stiffness_n_per_m);
  EXPECT_EQ(law.damping_n_s_per_m, same.damping_n_s_per_m);
  EXPECT_EQ(law.half_backlash_m, same.half_backlash_m);
  EXPECT_EQ(law.friction, same.friction);
  EXPECT_EQ(one.meshes[0].driving.runout_m.x, other.meshes[0].driving.runout_m.x);
  EXPECT_EQ(one.meshes[0].driven.runout_m.y, other.meshes[0].driven.runout_m.y);
  for (std::size_t s = 0; s < 2; ++s) {
    EXPECT_EQ(one.unbalance[s].real, other.unbalance[s].real);
    EXPECT_EQ(one.unbalance[s].imaginary, other.unbalance[s].imaginary);
  }
}

const std::vector<EffectConfig>& All() {
  static const std::vector<EffectConfig> entries{
      test::Entry(Id::kMeshStiffness, {2e6, 500.0}),
      test::Entry(Id::kMeshStiffnessVariation, {1.0, 0.2, 0.0}),
      test::Entry(Id::kBacklash, {40e-6}),
      test::Entry(Id::kMeshFriction, {0.1}),
      test::Entry(Id::kTransmissionError, {6.0, 10e-6, 0.0}),
      test::Entry(Id::kGearRunout, {30e-6, 0.5}),
      OnDriven(test::Entry(Id::kToothCrack, {0.5, 3.0}))};
  return entries;
}

TEST(GearEffects, OfStrengthZeroLeaveTheGearsAsTheyWere) {
  const TrainModel train = TrainAt(0.0, All());
  ExpectTheSame(train, Nominal());
  ASSERT_EQ(train.meshes[0].law.variation.size(), 1U);
  EXPECT_EQ(train.meshes[0].law.variation[0].relative_amplitude, 0.0);
  ASSERT_EQ(train.meshes[0].law.cracks.size(), 1U);
  EXPECT_EQ(train.meshes[0].law.cracks[0].depth, 0.0);
}

TEST(GearEffects, ComeAndGoWithTheirStrength) {
  PlantConfig config = test::GearedRotor4();
  config.effects = All();
  PlantModel model(config);
  model.SetStrengths(std::vector<double>(All().size(), 1.0));
  EXPECT_NE(model.train().meshes[0].law.stiffness_n_per_m,
            Nominal().meshes[0].law.stiffness_n_per_m);
  model.SetStrengths(std::vector<double>(All().size(), 0.0));
  ExpectTheSame(model.train(), Nominal());
}

TEST(GearEffects, TakeTheStiffnessTheyAreGivenAndHalfOfItAtHalfStrength) {
  const double own = Nominal().meshes[0].law.stiffness_n_per_m;
  const std::vector entries{test::Entry(Id::kMeshStiffness, {2e6, 500.0})};
  EXPECT_EQ(TrainAt(1.0, entries).meshes[0].law.stiffness_n_per_m, 2e6);
  EXPECT_EQ(TrainAt(1.0, entries).meshes[0].law.damping_n_s_per_m, 500.0);
  EXPECT_DOUBLE_EQ(TrainAt(0.5, entries).meshes[0].law.stiffness_n_per_m, 0.5 * (own + 2e6));
}

TEST(GearEffects, AddTheWholeGapAsHalfOnEitherSideAndTheFrictionToWhatThereIs) {
  PlantConfig config = test::GearedRotor4();
  config.gears[0].imperfection = {
      .backlash_m = 10e-6, .friction = 0.02, .variation = {}, .cracks = {}};
  config.effects = {test::Entry(Id::kBacklash, {40e-6}), test::Entry(Id::kMeshFriction, {0.1})};
  PlantModel model(config);
  model.SetStrengths(std::array{1.0, 1.0});
  EXPECT_DOUBLE_EQ(model.train().meshes[0].law.half_backlash_m, 25e-6);
  EXPECT_DOUBLE_EQ(model.train().meshes[0].law.friction, 0.12);
}

TEST(GearEffects, PutTheCrackOnTheToothAndWheelTheyName) {
  const TrainModel train = TrainAt(1.0, {OnDriven(test::Entry(Id::kToothCrack, {0.5, 3.0}))});
  ASSERT_EQ(train.meshes[0].law.cracks.size(), 1U);
  EXPECT_TRUE(train.meshes[0].law.cracks[0].on_driven);
  EXPECT_EQ(train.meshes[0].law.cracks[0].tooth, 3);
  EXPECT_EQ(train.meshes[0].law.cracks[0].depth, 0.5);
}

TEST(GearEffects, KeepTwoEntriesOfOneKindApart) {
  const TrainModel train =
      TrainAt(1.0, {test::Entry(Id::kMeshStiffnessVariation, {1.0, 0.2, 0.0}),
                    test::Entry(Id::kMeshStiffnessVariation, {2.0, 0.1, 0.4})});
  const auto& variation = train.meshes[0].law.variation;
  ASSERT_EQ(variation.size(), 2U);
  EXPECT_EQ(variation[0].order, 1);
  EXPECT_EQ(variation[0].relative_amplitude, 0.2);
  EXPECT_EQ(variation[1].order, 2);
  EXPECT_EQ(variation[1].relative_amplitude, 0.1);
  EXPECT_EQ(variation[1].phase_rad, 0.4);
}

// The pitch circle moves off the axis, and the wheel's mass with it: unbalance m e.
TEST(GearEffects, MoveTheMassOfAnEccentricWheelOffTheAxis) {
  constexpr double kOffM = 30e-6;
  constexpr double kPhaseRad = 0.5;
  const gear::GearPair pair = test::GearedRotor4().gears[0];
  for (const bool on_driven : {false, true}) {
    EffectConfig entry = test::Entry(Id::kGearRunout, {kOffM, kPhaseRad});
    entry.on_driven = on_driven;
    const TrainModel train = TrainAt(1.0, {entry});
    const MeshModel& mesh = train.meshes[0];
    const MeshModel& nominal = Nominal().meshes[0];
    const WheelModel& wheel = on_driven ? mesh.driven : mesh.driving;
    const WheelModel& before = on_driven ? nominal.driven : nominal.driving;
    EXPECT_NEAR(wheel.runout_m.x - before.runout_m.x, kOffM * std::cos(kPhaseRad), 1e-18);
    EXPECT_NEAR(wheel.runout_m.y - before.runout_m.y, kOffM * std::sin(kPhaseRad), 1e-18);
    const double mass_kg =
        on_driven ? pair.driven.eccentric_mass_kg : pair.driving.eccentric_mass_kg;
    const auto& shape = on_driven ? mesh.driven_shape : mesh.driving_shape;
    for (std::size_t i = 0; i < shape.size(); ++i) {
      EXPECT_NEAR(train.unbalance[wheel.shaft].real[i] - Nominal().unbalance[wheel.shaft].real[i],
                  shape[i] * mass_kg * kOffM * std::cos(kPhaseRad), 1e-15);
    }
    const std::size_t other = 1 - wheel.shaft;
    EXPECT_EQ(train.unbalance[other].real, Nominal().unbalance[other].real);
  }
}

}  // namespace
}  // namespace levitas::plant

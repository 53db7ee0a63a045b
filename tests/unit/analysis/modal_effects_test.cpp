#include "analysis/modal_effects.hpp"

#include <gtest/gtest.h>

#include "tests/support/effect_entry.hpp"
#include "tests/support/test_rigs.hpp"

namespace levitas::analysis {
namespace {

std::vector<effect::Id> KeptOf(std::initializer_list<effect::Id> given) {
  plant::PlantConfig rig = test::QuietFlexibleRotor();
  for (const effect::Id id : given) rig.effects.push_back(test::Entry(id, {}));
  std::vector<effect::Id> kept;
  for (const auto& entry : WithModalEffects(rig).effects) kept.push_back(entry.id);
  return kept;
}

TEST(WithModalEffects, KeepsWhatChangesTheFreeRotorInItsOrder) {
  EXPECT_EQ(KeptOf({effect::Id::kSensorGain, effect::Id::kRotorMass, effect::Id::kUnbalance,
                    effect::Id::kCouplingStiffness, effect::Id::kStaticLoad,
                    effect::Id::kModalFrequency}),
            (std::vector<effect::Id>{effect::Id::kRotorMass, effect::Id::kCouplingStiffness,
                                     effect::Id::kModalFrequency}));
}

TEST(WithModalEffects, LeavesOutWhatActsThroughTheMagnetsAndWhatTurnsWithTheRotor) {
  EXPECT_TRUE(KeptOf({effect::Id::kCurrentGain, effect::Id::kDisplacementStiffness,
                      effect::Id::kSupportMode})
                  .empty());
  EXPECT_TRUE(KeptOf({effect::Id::kShaftAnisotropy, effect::Id::kBreathingCrack}).empty());
}

TEST(WithModalEffects, HasThemAtFullStrengthFromTheStartAndAllElseAsItWas) {
  plant::PlantConfig rig = test::QuietFlexibleRotor();
  effect::EffectConfig entry = test::Entry(effect::Id::kModalFrequency, {321.0});
  entry.mode = 2;
  entry.strength = 0.5;
  entry.at_s = 3.0;
  entry.ramp_s = 4.0;
  rig.effects = {entry};
  const plant::PlantConfig with = WithModalEffects(rig);
  ASSERT_EQ(with.effects.size(), 1U);
  EXPECT_FALSE(with.effects[0].timed());
  EXPECT_EQ(with.effects[0].mode, 2U);
  EXPECT_EQ(with.effects[0].values[0], 321.0);
  EXPECT_EQ(with.effects[0].strength, 0.5) << "full is what the rig file says";
  EXPECT_EQ(with.rotor.discs.size(), rig.rotor.discs.size());
  EXPECT_EQ(with.bearings.size(), rig.bearings.size());
  EXPECT_TRUE(rig.effects[0].timed()) << "the given rig stays";
}

}  // namespace
}  // namespace levitas::analysis

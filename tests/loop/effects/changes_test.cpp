// Effects that change while the rig runs: drift, sudden onset, by hand; copies and allocations.
#include <gtest/gtest.h>

#include "plant_sim/plant/linear_model.hpp"
#include "tests/loop/effects/effect_rig.hpp"
#include "tests/support/allocation_guard.hpp"
#include "tests/support/test_rigs.hpp"

namespace levitas::plant::test {
namespace {

constexpr double kTurning_rad_per_s = 180.0;

PlantConfig ChangingRig() { return levitas::test::FlexibleRotor(); }

/// All effects at once, each a little: what must not allocate.
PlantConfig Everything(double strength) {
  PlantConfig rig = ChangingRig();
  for (const effect::Id id : AllIds()) {
    rig.effects.push_back(ClearOn(rig, id));
    rig.effects.back().strength = strength;
  }
  return rig;
}

std::vector<SensorFrame> SamplesOf(Plant& plant, int periods) {
  return RunLevitated(plant, kTurning_rad_per_s, periods);
}

TEST(EffectChanges, OfAStepEqualAPlantThatHadTheEffectFromThereOn) {
  PlantConfig rig = ChangingRig();
  rig.effects.push_back(ClearOn(rig, effect::Id::kSensorGain));
  rig.effects[0].at_s = 0.02;  // period 200
  Plant timed(rig, 1);
  const auto late = SamplesOf(timed, 400);
  rig.effects[0].at_s = 0.0;
  Plant by_hand(rig, 1);
  by_hand.AllowEffectChanges();
  ASSERT_TRUE(by_hand.SetEffectStrength(0, 0.0));
  SimpleLaw law;
  law.speed_rad_per_s = kTurning_rad_per_s;
  by_hand.SetSpeed(kTurning_rad_per_s, 0.0);
  Plant nominal(ChangingRig(), 1);
  const auto without = SamplesOf(nominal, 400);
  for (int i = 0; i < 400; ++i) {
    if (i == 200) {
      ASSERT_TRUE(by_hand.SetEffectStrength(0, 1.0));
    }
    const SensorFrame frame = StepOnce(by_hand, law);
    const auto at = static_cast<std::size_t>(i);
    ASSERT_EQ(late[at].position_m, frame.position_m) << "period " << i;
    if (i <= 200) {
      ASSERT_EQ(late[at].position_m, without[at].position_m) << "period " << i;
    }
  }
  EXPECT_NE(late[399].position_m, without[399].position_m);
}

TEST(EffectChanges, AreRefusedWithoutPermissionOrWithAWrongIndexOrStrength) {
  PlantConfig rig = ChangingRig();
  rig.effects.push_back(ClearOn(rig, effect::Id::kExtraDelay));
  Plant plant(rig, 1);
  EXPECT_FALSE(plant.SetEffectStrength(0, 0.5));
  plant.AllowEffectChanges();
  EXPECT_TRUE(plant.SetEffectStrength(0, 0.5));
  EXPECT_FALSE(plant.SetEffectStrength(1, 0.5));
  EXPECT_FALSE(plant.SetEffectStrength(0, 1.5));
  EXPECT_FALSE(plant.SetEffectStrength(0, -0.1));
}

TEST(EffectChanges, ScaleTheValuesBetweenNeutralAndFull) {
  PlantConfig rig = ChangingRig();
  rig.effects.push_back(ClearOn(rig, effect::Id::kExtraDelay));
  rig.effects[0].values[0] = 160e-6;
  Plant plant(rig, 1);
  plant.AllowEffectChanges();
  for (const double strength : {0.0, 0.25, 1.0}) {
    ASSERT_TRUE(plant.SetEffectStrength(0, strength));
    // 1 sample of the rig and 1.6 of the effect.
    EXPECT_NEAR(plant.model().delay_samples(), 1.0 + strength * 1.6, 1e-12);
  }
}

TEST(EffectChanges, OfACopyLeaveTheOriginalAlone) {
  PlantConfig rig = ChangingRig();
  rig.effects.push_back(ClearOn(rig, effect::Id::kEddyCurrent));
  Plant original(rig, 1);
  original.AllowEffectChanges();
  Plant copy(original);
  Plant assigned(ChangingRig(), 9);
  assigned = original;
  ASSERT_TRUE(copy.SetEffectStrength(0, 0.0));
  EXPECT_EQ(original.model().effects().bearings[0].axis[0].eddy_tau_s, 50e-6);
  EXPECT_EQ(assigned.model().effects().bearings[0].axis[0].eddy_tau_s, 50e-6);
  EXPECT_EQ(copy.model().effects().bearings[0].axis[0].eddy_tau_s, 0.0);
}

TEST(Effects, AllTogetherRunOnInACopyBitForBit) {
  Plant plant(Everything(0.05), 5);
  (void)SamplesOf(plant, 100);
  Plant copy(plant);
  SimpleLaw law;
  law.speed_rad_per_s = kTurning_rad_per_s;
  SimpleLaw same_law = law;
  for (int i = 0; i < 200; ++i) {
    const SensorFrame a = StepOnce(plant, law);
    const SensorFrame b = StepOnce(copy, same_law);
    ASSERT_EQ(a.position_m, b.position_m) << "period " << i;
  }
}

TEST(Effects, AllTogetherAllocateNothingNeitherRunningNorChanging) {
  PlantConfig rig = Everything(0.05);
  rig.effects[3].ramp_s = 0.02;
  Plant plant(rig, 5);
  SimpleLaw law;
  law.speed_rad_per_s = kTurning_rad_per_s;
  plant.SetSpeed(kTurning_rad_per_s, 0.0);
  const levitas::test::AllocationGuard guard;
  for (int i = 0; i < 300; ++i) {
    (void)StepOnce(plant, law);
    for (std::size_t e = 0; e < rig.effects.size(); ++e) {
      if (e != 3) (void)plant.SetEffectStrength(e, 0.05 + 0.0001 * (i % 10));
    }
  }
  EXPECT_EQ(guard.count(), 0U);
  EXPECT_TRUE(plant.finite());
}

TEST(Effects, OfOneIdAtTwoPlacesActAtBoth) {
  PlantConfig rig = ChangingRig();
  rig.effects.push_back(ClearOn(rig, effect::Id::kCurrentGain));
  rig.effects.push_back(rig.effects[0]);
  rig.effects[0].axes = 0b0001;
  rig.effects[0].values[0] = 0.9;
  rig.effects[1].axes = 0b1000;
  rig.effects[1].values[0] = 1.2;
  const PlantModel model(rig);
  const auto& bearings = model.effects().bearings;
  EXPECT_EQ(bearings[0].axis[0].gain, 0.9);
  EXPECT_EQ(bearings[0].axis[1].gain, 1.0);
  EXPECT_EQ(bearings[1].axis[0].gain, 1.0);
  EXPECT_EQ(bearings[1].axis[1].gain, 1.2);
}

TEST(Effects, ThatFightForOnePlaceAreRefused) {
  PlantConfig rig = ChangingRig();
  rig.effects.push_back(ClearOn(rig, effect::Id::kEddyCurrent));
  rig.effects.push_back(ClearOn(rig, effect::Id::kEddyCurrent));
  EXPECT_THROW(PlantModel{rig}, std::invalid_argument);
  rig.effects[0].axes = 0b0011;
  rig.effects[1].axes = 0b1100;
  EXPECT_NO_THROW(PlantModel{rig});
  rig.effects = {ClearOn(rig, effect::Id::kMisalignment), ClearOn(rig, effect::Id::kMisalignment)};
  EXPECT_NO_THROW(PlantModel{rig});  // two orders of a coupling add up
}

TEST(Effects, OfWhatTheRigDoesNotHaveAreRefused) {
  PlantConfig rig = ChangingRig();
  rig.effects.push_back(ClearOn(rig, effect::Id::kSupportMode));
  rig.effects[0].bearing = 2;
  EXPECT_THROW(PlantModel{rig}, std::invalid_argument);
  rig.effects = {ClearOn(rig, effect::Id::kModalDamping)};
  rig.effects[0].mode = 7;  // eight modes kept, two of them rigid
  EXPECT_THROW(PlantModel{rig}, std::invalid_argument);
  rig.effects = {ClearOn(rig, effect::Id::kUnbalance)};
  rig.effects[0].values[0] = 0.6;  // the shaft ends at 0.4572 m
  EXPECT_THROW(PlantModel{rig}, std::invalid_argument);
  rig.effects = {ClearOn(rig, effect::Id::kSensorGain)};
  rig.effects[0].axes = 0b10000;
  EXPECT_THROW(PlantModel{rig}, std::invalid_argument);
}

TEST(StatesOfEffects, StandBehindTheNominalOnes) {
  PlantConfig rig = ChangingRig();
  const StateLayout nominal = Plant(rig, 1).layout();
  rig.effects.push_back(ClearOn(rig, effect::Id::kEddyCurrent));
  rig.effects.push_back(ClearOn(rig, effect::Id::kHysteresis));
  rig.effects.push_back(ClearOn(rig, effect::Id::kSupportMode));
  const StateLayout extended = Plant(rig, 1).layout();
  EXPECT_EQ(extended.effects, nominal.size);
  EXPECT_EQ(extended.sensor, nominal.sensor);
  // Ten lags and one z on each of four axes; x, y and their rates of one housing.
  EXPECT_EQ(extended.size, nominal.size + 4 * 10 + 4 + 4);
}

}  // namespace
}  // namespace levitas::plant::test

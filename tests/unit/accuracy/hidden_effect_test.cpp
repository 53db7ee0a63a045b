// Drawn effects: every one of them can be put into the rig, at any size, and differs by seed.

#include "benchmark/accuracy/hidden_effect.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "benchmark/accuracy/perturbed_rig.hpp"
#include "benchmark/accuracy/trial.hpp"
#include "plant_sim/effect/catalogue.hpp"
#include "plant_sim/plant/plant_model.hpp"

namespace levitas::accuracy {
namespace {

const TestRig& TheBench() {
  static const TestRig bench = LoadTestRig("flexible_rotor", {"flexible_rotor"});
  return bench;
}

TEST(HiddenEffects, OfEveryIdAndSizeAreAcceptedByTheRig) {
  const auto nominal = plant::Reduce(TheBench().rig.plant);
  std::uint64_t seed = 0;
  for (const effect::Id id : HiddenIds()) {
    for (const double size : {0.15, 1.0}) {
      Random random(++seed);
      const auto entries = DrawEffect(id, size, nominal, random);
      ASSERT_FALSE(entries.empty());
      for (const auto& entry : entries) EXPECT_EQ(entry.id, id);
      // The model's constructor refuses values, channels or places that the rig cannot have.
      EXPECT_NO_THROW(plant::PlantModel(PerturbedRig(TheBench().rig.plant, {}, entries, random)))
          << effect::At(id).name << " at " << size;
    }
  }
}

TEST(HiddenEffects, OfTeethAreNotDrawnAsOnesOfTheRotor) {
  const auto nominal = plant::Reduce(TheBench().rig.plant);
  Random random(3);
  for (const effect::Row& row : effect::GearRows()) {
    EXPECT_THROW((void)DrawEffect(row.id, 1.0, nominal, random), std::logic_error) << row.name;
  }
}

TEST(HiddenEffects, DifferBySeedAndRepeatWithIt) {
  const auto nominal = plant::Reduce(TheBench().rig.plant);
  const auto moment = [&](std::uint64_t seed) {
    Random random(seed);
    return DrawEffect(effect::Id::kUnbalance, 1.0, nominal, random).front().values;
  };
  EXPECT_EQ(moment(5), moment(5));
  EXPECT_NE(moment(5), moment(6));
}

TEST(PerturbedRig, IsAFewPerCentOffEverywhereAndHasMoreModesAndFinerSteps) {
  const auto& nominal = TheBench().rig.plant;
  Random random(7);
  const auto truth = PerturbedRig(nominal, {}, {}, random);
  const auto healthy = plant::Reduce(nominal);
  EXPECT_GT(truth.config.substeps, nominal.substeps);
  ASSERT_GT(truth.modes.frequency_rad_per_s.size(), healthy.modes.frequency_rad_per_s.size());
  for (Eigen::Index i = 2; i < healthy.modes.frequency_rad_per_s.size(); ++i) {
    const double ratio = truth.modes.frequency_rad_per_s[i] / healthy.modes.frequency_rad_per_s[i];
    EXPECT_NE(ratio, 1.0);
    // Two standard deviations of 0.7 %: where draws are limited.
    EXPECT_NEAR(ratio, 1.0, 0.0141);
  }
}

TEST(PerturbedRig, CombinesAHiddenRatioWithThatOfTheHealthyRig) {
  effect::EffectConfig hidden;
  hidden.id = effect::Id::kCurrentGain;
  hidden.axes = 1U;
  hidden.values[0] = 1.2;
  Random same(7);
  Random again(7);
  const auto without = PerturbedRig(TheBench().rig.plant, {}, {}, same);
  const auto with = PerturbedRig(TheBench().rig.plant, {}, {hidden}, again);
  ASSERT_EQ(with.config.effects.size(), without.config.effects.size());
  for (std::size_t i = 0; i < with.config.effects.size(); ++i) {
    const auto& a = without.config.effects[i];
    const auto& b = with.config.effects[i];
    const bool hit = a.id == effect::Id::kCurrentGain && a.Acts(0);
    EXPECT_EQ(b.values[0], hit ? 1.2 * a.values[0] : a.values[0]);
  }
}

}  // namespace
}  // namespace levitas::accuracy

// What records hold for an effect: nothing of what tolerances imitate, the square of its size else.

#include "trials/held_evidence.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "plant_sim/effect/catalogue.hpp"
#include "trials/trial.hpp"

namespace levitas::trials {
namespace {

constexpr int kBits = 1275;  // 1.02 s: the shortest record that a diagnosis takes

const Bench& TheBench() {
  static const Bench bench = LoadBench("flexible_rotor", {"flexible_rotor"});
  return bench;
}

const Trial& Healthy() {
  static const Trial trial = [] {
    TrialPlan plan;
    plan.seed = 3;
    plan.bits_per_axis = kBits;
    plan.runup_s = 1.05;
    return MakeTrial(TheBench(), plan);
  }();
  return trial;
}

effect::EffectConfig Entry(effect::Id id, std::initializer_list<double> values,
                           std::uint32_t axes) {
  effect::EffectConfig entry;
  entry.id = id;
  entry.axes = axes;
  std::copy(values.begin(), values.end(), entry.values.begin());
  return entry;
}

std::optional<double> Held(effect::Id id, std::initializer_list<double> values) {
  return HeldEvidence(TheBench().rig, Healthy().records, {Entry(id, values, 1U)});
}

TEST(HeldEvidence, OfWhatATenthOfAToleranceImitatesIsNoMoreThanItsPrice) {
  const auto tolerances = TheBench().rig.tolerances.value_or(config::Tolerances{});
  // A micrometre, which no slow observer takes away: some thousand nats were there no tolerance of
  // it. With it 1/2 0.1^2, and a quarter more for the magnets' curvature.
  const auto offset = Held(effect::Id::kSensorOffset, {0.1 * tolerances.sensor_offset_m});
  ASSERT_TRUE(offset.has_value());
  EXPECT_LT(*offset, 1.25 * 0.005);
  EXPECT_GT(*offset, 0.0);
}

TEST(HeldEvidence, GrowsWithTheSquareOfWhatNoToleranceImitates) {
  // A second harmonic: no tolerance has one, and it is read without anything between.
  const auto small = Held(effect::Id::kSensorRunout, {2.0, 0.1e-6, 0.3});
  const auto twice = Held(effect::Id::kSensorRunout, {2.0, 0.2e-6, 0.3});
  ASSERT_TRUE(small.has_value() && twice.has_value());
  EXPECT_EQ(SizeOf(*small), Size::kClear);
  // Linear as far as the magnets are: 1 % at a thousandth of the gap, which a slow observer lets
  // swing up.
  EXPECT_NEAR(*twice / *small, 4.0, 0.04);
}

TEST(HeldEvidence, IsNothingForAnEffectThatChangesNothing) {
  const auto neutral = Held(effect::Id::kSensorGain, {1.0});
  ASSERT_TRUE(neutral.has_value());
  EXPECT_LT(*neutral, 1e-9);  // rounding of single precision, squared
}

TEST(HeldEvidence, IsNotKnownForNoiseAndForNothing) {
  EXPECT_FALSE(Held(effect::Id::kSensorNoise, {3e-6}).has_value());
  EXPECT_FALSE(HeldEvidence(TheBench().rig, Healthy().records, {}).has_value());
}

}  // namespace
}  // namespace levitas::trials

// What records hold for an effect: nothing of what tolerances imitate, the square of its size else.

#include "benchmark/accuracy/available_evidence.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "benchmark/accuracy/trial.hpp"
#include "plant_sim/effect/catalogue.hpp"
#include "tests/support/effect_entry.hpp"

namespace levitas::accuracy {
namespace {

constexpr int kBits = 1275;  // 1.02 s: the shortest record that a diagnosis takes

const TestRig& TheBench() {
  static const TestRig bench = LoadTestRig("flexible_rotor", {"flexible_rotor"});
  return bench;
}

Trial With(std::vector<effect::Id> hidden) {
  TrialPlan plan;
  plan.seed = 3;
  plan.hidden = std::move(hidden);
  plan.bits_per_axis = kBits;
  plan.runup_s = 1.05;
  return MakeTrial(TheBench(), plan);
}

const Trial& Healthy() {
  static const Trial trial = With({});
  return trial;
}

std::optional<double> Held(effect::Id id, std::initializer_list<double> values) {
  return AvailableEvidence(TheBench().rig, Healthy().records, {test::Entry(id, values, 1U)});
}

TEST(AvailableEvidence, IsMuchWhereTheEffectIsAndNegativeWhereItIsNot) {
  const Trial hidden = With({effect::Id::kSensorRunout});
  const auto held = AvailableEvidence(TheBench().rig, hidden.records, hidden.ground_truth.hidden);
  ASSERT_TRUE(held.has_value());
  EXPECT_EQ(SizeOf(*held), Size::kClear);
  const auto absent =
      AvailableEvidence(TheBench().rig, Healthy().records, hidden.ground_truth.hidden);
  ASSERT_TRUE(absent.has_value());
  EXPECT_LT(*absent, -25.0);
}

// Of an effect that another one does already, little is left to hold.
TEST(AvailableEvidence, BesideAnotherEffectIsWhatThatLeaves) {
  const Trial hidden = With({effect::Id::kSensorRunout});
  auto half = hidden.ground_truth.hidden;
  for (auto& entry : half) entry.values[1] *= 0.5;
  const auto whole = AvailableEvidence(TheBench().rig, hidden.records, hidden.ground_truth.hidden);
  const auto rest = AvailableEvidence(TheBench().rig, hidden.records, half, half);
  const auto again = AvailableEvidence(TheBench().rig, hidden.records, hidden.ground_truth.hidden,
                                       hidden.ground_truth.hidden);
  ASSERT_TRUE(whole && rest && again);
  EXPECT_GT(*rest, 0.0);
  EXPECT_LT(*rest, *whole);
  EXPECT_LT(*again, -25.0);
}

TEST(AvailableEvidence, OfWhatATenthOfAToleranceImitatesIsNearlyNothing) {
  // A micrometre, which no slow observer takes away: some thousand nats were there no tolerance of
  // it.
  const auto tolerances = TheBench().rig.tolerances.value_or(configuration::Tolerances{});
  const auto offset = Held(effect::Id::kSensorOffset, {0.1 * tolerances.sensor_offset_m});
  ASSERT_TRUE(offset.has_value());
  EXPECT_LT(std::abs(*offset), 1.0);
}

TEST(AvailableEvidence, IsNothingForAnEffectThatChangesNothing) {
  const auto neutral = Held(effect::Id::kSensorGain, {1.0});
  ASSERT_TRUE(neutral.has_value());
  EXPECT_LT(std::abs(*neutral), 1e-6);
}

TEST(AvailableEvidence, IsNotKnownForNoiseAndForNothing) {
  EXPECT_FALSE(Held(effect::Id::kSensorNoise, {3e-6}).has_value());
  EXPECT_FALSE(AvailableEvidence(TheBench().rig, Healthy().records, {}).has_value());
}

}  // namespace
}  // namespace levitas::accuracy

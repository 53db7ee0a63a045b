// What the iron remembers and what a sensor reads beside the motion.

#include "plant_sim/plant/applied_effects/effect_signals.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "plant_sim/effect/eddy_current.hpp"
#include "tests/support/effect_entry.hpp"
#include "tests/support/test_rigs.hpp"

namespace levitas::plant {
namespace {

using effect::Id;

constexpr double kAngleRad = 0.3;

/// Two bearings without any effect.
EffectModel Plain() {
  EffectModel effects;
  effects.bearings.resize(2);
  effects.turns.resize(2);
  return effects;
}

TEST(SeenByMagnets, IsTheSameWhereTheAxesAgree) {
  const AxisArray position_m{1e-5, -2e-5, 3e-5, 4e-5};
  EXPECT_EQ(SeenByMagnets(Plain(), position_m), position_m);
}

TEST(SeenByMagnets, TurnsTheDisplacementBackByTheAngleOfTheMagnet) {
  EffectModel effects = Plain();
  effects.bearings[1].cosine = std::cos(kAngleRad);
  effects.bearings[1].sine = std::sin(kAngleRad);
  // Of 50 um towards 0.3 rad the magnet's own x axis sees all, its y axis nothing.
  const AxisArray position_m{1e-5, 2e-5, 50e-6 * std::cos(kAngleRad), 50e-6 * std::sin(kAngleRad)};
  const AxisArray seen_m = SeenByMagnets(effects, position_m);
  EXPECT_EQ(seen_m[0], 1e-5);
  EXPECT_EQ(seen_m[1], 2e-5);
  EXPECT_NEAR(seen_m[2], 50e-6, 1e-18);
  EXPECT_NEAR(seen_m[3], 0.0, 1e-18);
}

/// Axis 0 with a lag and axis 1 with a loop.
class Memory : public testing::Test {
 protected:
  static constexpr double kWidthA = 0.2;
  static constexpr double kAPerM = 1000.0;

  Memory() {
    effects_.bearings[0].axis[0].eddy_state = 0;
    effects_.bearings[0].axis[0].eddy_tau_s = 1e-3;
    effects_.bearings[0].axis[0].eddy_a_per_m = kAPerM;
    effects_.bearings[0].axis[1].hysteresis_state = effect::kEddyLags;
    effects_.bearings[0].axis[1].hysteresis_width_a = kWidthA;
    effects_.bearings[0].axis[1].hysteresis_shape = 1.0;
    // Each lag moves half of the way to an input that stands still.
    table_.eddy.assign(4 * effect::kEddyLags, {.decay = 0.5, .start = 0.25, .end = 0.25});
  }
  [[nodiscard]] AxisArray Flux(const MagnetInput& input) const {
    return Magnetising(effects_, input, state_.data());
  }

  EffectModel effects_ = Plain();
  StepTable table_;
  std::vector<double> state_ = std::vector<double>(effect::kEddyLags + 1, 0.0);
};

// Lagged are current and displacement together; the force law adds the displacement itself.
TEST_F(Memory, ThatHasSettledLeavesTheCurrentAsItIs) {
  const MagnetInput input{.control_a = {0.4, 0.1}, .displacement_m = {30e-6, 0.0}};
  SettleMemory(effects_, input, state_.data());
  // The lags' shares add up to 1 within their rounding.
  EXPECT_NEAR(Flux(input)[0], 0.4, 1e-12);
  AdvanceMemory(effects_, table_, input, input, state_.data());
  EXPECT_NEAR(Flux(input)[0], 0.4, 1e-12);
}

TEST_F(Memory, OfTheEddyCurrentsFollowsAStepFromBelowAndArrives) {
  const MagnetInput step{.control_a = {1.0}, .displacement_m = {}};
  double last_a = Flux(step)[0];
  EXPECT_NEAR(last_a, effect::Eddy().direct, 1e-12);  // what is too fast to be seen is there
  for (int i = 0; i < 60; ++i) {
    AdvanceMemory(effects_, table_, step, step, state_.data());
    EXPECT_GE(Flux(step)[0], last_a);
    last_a = Flux(step)[0];
  }
  EXPECT_NEAR(last_a, 1.0, 1e-12);
}

TEST_F(Memory, OfALoopTakesItsWidthInTheDirectionOfTheLastMotion) {
  MagnetInput before{};
  MagnetInput after{};
  after.control_a[1] = 100.0 * kWidthA;  // far enough to saturate
  AdvanceMemory(effects_, table_, before, after, state_.data());
  EXPECT_NEAR(Flux(after)[1], after.control_a[1] - kWidthA, 1e-9);
  before = after;
  after.control_a[1] = 0.0;
  AdvanceMemory(effects_, table_, before, after, state_.data());
  EXPECT_NEAR(Flux(after)[1], kWidthA, 1e-9);
}

TEST_F(Memory, WithoutStatesIsNone) {
  const MagnetInput input{.control_a = {0.0, 0.0, 0.7, -0.3}, .displacement_m = {}};
  const AxisArray flux_a = Flux(input);
  EXPECT_EQ(flux_a[2], 0.7);
  EXPECT_EQ(flux_a[3], -0.3);
}

AxisArray Viewed(const PlantConfig& config, double angle_rad, AxisArray position_m) {
  const PlantModel model(config);
  const std::vector<double> state(model.layout().size, 0.0);
  View(model, std::cos(angle_rad), std::sin(angle_rad), state.data(), position_m);
  return position_m;
}

TEST(View, OfARigWithoutEffectsIsTheDisplacement) {
  const AxisArray position_m{1e-5, -2e-5, 3e-5, 4e-5};
  EXPECT_EQ(Viewed(test::QuietFlexibleRotor(), 0.7, position_m), position_m);
}

// y = A cos(n (angle - probe) + phase), the y probe 90 degrees further.
TEST(View, AddsTheRunoutThatTurnsPastProbesThatStandStill) {
  PlantConfig config = test::QuietFlexibleRotor();
  constexpr double kOrder = 3.0;
  config.effects = {test::Entry(Id::kSensorRunout, {kOrder, 10e-6, 0.4}, 0b0011)};
  for (const double angle_rad : {0.0, 0.5, 2.0, -1.3}) {
    const AxisArray seen_m = Viewed(config, angle_rad, {});
    EXPECT_NEAR(seen_m[0], 10e-6 * std::cos(kOrder * angle_rad + 0.4), 1e-18);
    EXPECT_NEAR(seen_m[1], 10e-6 * std::cos(kOrder * (angle_rad - 0.5 * std::numbers::pi) + 0.4),
                1e-18);
    EXPECT_EQ(seen_m[2], 0.0);
    EXPECT_EQ(seen_m[3], 0.0);
  }
}

TEST(AddOutputs, AddsTheOffsetOfEachAxisAndPickupAtItsFrequencyAndPhase) {
  EffectModel effects = Plain();
  effects.readings[2].offset_m = 5e-6;
  effects.pickups = {{.axis = 1, .frequency_hz = 50.0, .amplitude_m = 2e-6, .phase_rad = 0.3}};
  for (const double time_s : {0.0, 1e-3, 7.123e-3}) {
    AxisArray output_m{};
    AddOutputs(effects, 4, time_s, output_m);
    EXPECT_EQ(output_m[0], 0.0);
    EXPECT_NEAR(output_m[1], 2e-6 * std::cos(100.0 * std::numbers::pi * time_s + 0.3), 1e-20);
    EXPECT_EQ(output_m[2], 5e-6);
  }
}

}  // namespace
}  // namespace levitas::plant

#include "design/hinf/hinf_design.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "analysis/sensitivity.hpp"
#include "common/problem.hpp"
#include "common/rotational_speed.hpp"
#include "tests/support/shipped_loop.hpp"

namespace levitas::hinf {
namespace {

const configuration::RigFile& Shipped() {
  static const configuration::RigFile rig =
      configuration::LoadRig(configuration::FindConfig("flexible_rotor", "rigs"));
  return rig;
}

HinfDesignOptions ForTheRig() {
  return {.current_limit_a = 1.0, .top_speed_rad_per_s = RpmToRadPerS(6000.0)};
}

/// Made once: a fifth of a second.
const HinfDesign& DefaultDesign() {
  static const HinfDesign design = DesignHinf(Shipped().plant, HinfWeights{}, ForTheRig());
  return design;
}

std::string Refusal(const HinfWeights& weights) {
  try {
    static_cast<void>(DesignHinf(Shipped().plant, weights, ForTheRig()));
  } catch (const Problem& problem) {
    return problem.what();
  }
  return "";
}

// The nonlinear rig: contact, current limit, noise, gravity, and every speed on the way.
TEST(HinfDesign, RunsTheRigThroughItsWholeSpeedRangeWithinTheObjective) {
  test::ShippedLoop loop("flexible_rotor", "run_up_6000");
  loop.controller.law = DefaultDesign().law;
  EXPECT_EQ(loop.Play(1, 60.0), "");
  EXPECT_GT(loop.most.speed_rad_per_s, RpmToRadPerS(5950.0));
  EXPECT_EQ(loop.most.contact_n, 0.0);
  EXPECT_LT(loop.most.orbit_m, Shipped().numbers.spinning_orbit_objective_m);
}

TEST(HinfDesign, HoldsTheSampledLoopBeyondTheRatedSpeed) {
  // Exact delay, every mode, the loaded rotor: another linear model than the design's.
  for (double rpm = 0.0; rpm <= 7000.0; rpm += 1000.0) {
    const auto judged =
        analysis::SensitivityPeaks(Shipped().plant, DefaultDesign().law, RpmToRadPerS(rpm));
    EXPECT_TRUE(judged.stable) << rpm << " rpm";
    for (const auto& axis : judged.axes)
      EXPECT_LT(axis.peak, 4.0) << rpm << " rpm";  // ISO 14839-3: zone B
  }
}

TEST(HinfDesign, HasAsManyStatesAsAskedForAndNoneThatGrows) {
  EXPECT_EQ(DefaultDesign().states, 48U);
  EXPECT_GT(DefaultDesign().slowest_pole_1_per_s, 0.0);
  HinfDesignOptions fewer = ForTheRig();
  fewer.most_states = 44;
  EXPECT_EQ(DesignHinf(Shipped().plant, HinfWeights{}, fewer).states, 44U);
}

TEST(HinfDesign, GivesBothPlanesOfARoundRotorTheSameLawAndNoCrossing) {
  const auto& law = *DefaultDesign().law.state_space;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      const double across = (i + j) % 2 == 1 ? law.direct[i][j] : 0.0;
      EXPECT_EQ(across, 0.0) << i << " " << j;
      EXPECT_EQ(law.direct[i][j], law.direct[i ^ 1U][j ^ 1U]) << i << " " << j;
    }
}

TEST(HinfDesign, TrustingTheModesExactlyLosesThemAtTopSpeed) {
  // The harm that the uncertain modes prevent: made at rest, it meets the split modes at speed.
  HinfWeights weights;
  weights.mode_hz = 1e-3;
  const HinfDesign design = MakeLaw(Shipped().plant, weights, ForTheRig());
  EXPECT_FALSE(
      analysis::SensitivityPeaks(Shipped().plant, design.law, RpmToRadPerS(6000.0)).stable);
}

TEST(HinfDesign, HoldsTheRigAtTopSpeedByItsSpeedInPlaceOfItsModes) {
  // The same modes trusted, the speed not: what splits them is perturbed instead.
  HinfWeights weights;
  weights.mode_hz = 1e-3;
  weights.speed_ratio = 1.0;
  const HinfDesign design = MakeLaw(Shipped().plant, weights, ForTheRig());
  for (const double rpm : {0.0, 3000.0, 6000.0})
    EXPECT_TRUE(analysis::SensitivityPeaks(Shipped().plant, design.law, RpmToRadPerS(rpm)).stable)
        << rpm;
}

TEST(HinfDesign, RefusesALawThatGrowsByItself) {
  HinfWeights weights;
  weights.mode_hz = 1e-3;
  ASSERT_LT(MakeLaw(Shipped().plant, weights, ForTheRig()).slowest_pole_1_per_s, 0.0);
  EXPECT_THAT(Refusal(weights), ::testing::HasSubstr("the law itself grows by"));
}

TEST(HinfDesign, NamesTheWeightThatCannotBe) {
  HinfWeights weights;
  weights.noise_m = 0.0;
  EXPECT_THAT(Refusal(weights), ::testing::HasSubstr("noise_m is 0, allowed above 0"));
  weights = {};
  weights.position_rest_m = 1e-3;
  EXPECT_THAT(Refusal(weights), ::testing::HasSubstr("position_rest_m 0.001 is above position_m"));
}

}  // namespace
}  // namespace levitas::hinf

#include "design/hinf/hinf_design.hpp"
#include "common/rotational_speed.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "analysis/sensitivity.hpp"
#include "common/problem.hpp"
#include "tests/support/test_rigs.hpp"

namespace levitas::hinf {
namespace {

TEST(HinfDesign, OfTheFlexibleRotorHoldsItFromRestToTopSpeed) {
  const plant::PlantConfig rig = test::QuietFlexibleRotor();
  const HinfDesign design =
      DesignHinf(rig, 1.0, HinfWeights{}, {.speed_rad_per_s = RpmToRadPerS(3000.0), .turns = 1});
  EXPECT_LE(design.states, static_cast<Eigen::Index>(law::StateSpaceConfig::kMaxStates));
  // The sampled loop of the rig, exact delay, every mode: another linear model than the design's.
  for (const double rpm : {0.0, 1600.0, 3000.0, 6000.0}) {
    const auto judged = analysis::SensitivityPeaks(rig, design.law, RpmToRadPerS(rpm));
    EXPECT_TRUE(judged.stable) << rpm << " rpm";
    for (const auto& axis : judged.axes)
      EXPECT_LT(axis.peak, 3.0) << rpm << " rpm";  // ISO 14839-3: zone A
  }
}

TEST(HinfDesign, IgnoringTheModesMotionLosesThemAtAnotherSpeed) {
  // The harm that the uncertain modes prevent: a controller that may trust them exactly.
  const plant::PlantConfig rig = test::QuietFlexibleRotor();
  const HinfDesign design = DesignHinf(rig, 1.0, {.mode_hz = 1e-3},
                                       {.speed_rad_per_s = RpmToRadPerS(3000.0), .turns = 1});
  EXPECT_TRUE(analysis::SensitivityPeaks(rig, design.law, RpmToRadPerS(3000.0)).stable);
  EXPECT_FALSE(analysis::SensitivityPeaks(rig, design.law, 0.0).stable);
}

TEST(HinfDesign, NamesTheWeightThatCannotBe) {
  const auto refusal = [](const HinfWeights& weights) -> std::string {
    try {
      static_cast<void>(DesignHinf(test::QuietFlexibleRotor(), 1.0, weights, {}));
    } catch (const Problem& problem) {
      return problem.what();
    }
    return "";
  };
  EXPECT_THAT(refusal({.noise_m = 0.0}), ::testing::HasSubstr("noise_m is 0, allowed above 0"));
  EXPECT_THAT(refusal({.position_rest_m = 1e-3}),
              ::testing::HasSubstr("position_rest_m 0.001 is above position_m"));
}

}  // namespace
}  // namespace levitas::hinf

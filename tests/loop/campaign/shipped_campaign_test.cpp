// The shipped campaign of test signals, in closed loop with the rig it was written for.
#include <gtest/gtest.h>

#include <cmath>

#include "common/rotational_speed.hpp"
#include "tests/support/shipped_loop.hpp"

namespace levitas {
namespace {

constexpr double kAmplitudeA = 0.15;  // of every signal of config/scenarios/identify.yaml
constexpr double kBoundM = 75e-6;     // stated there
constexpr double kWholeS = 60.0;      // it takes 53 s

/// Cycles whose signal is neither whole nor silent: a period with one of them is of no use.
std::uint64_t CutBack(test::ShippedLoop& loop) {
  std::uint64_t cut = 0;
  const std::string trouble = loop.Play(1, kWholeS, [&](const cycle::CycleRecord& record) {
    for (const double excitation_a : record.in.op.excitation_a) {
      if (excitation_a != 0.0 && std::abs(excitation_a) != kAmplitudeA) ++cut;
    }
  });
  EXPECT_EQ(trouble, "");
  return cut;
}

TEST(ShippedCampaign, ExcitesWithWholePeriodsInsideItsStatedBoundUpToFullSpeed) {
  test::ShippedLoop loop("flexible_rotor", "identify");
  EXPECT_EQ(CutBack(loop), 0U);
  EXPECT_LT(loop.most.orbit_m, kBoundM);
  EXPECT_EQ(loop.most.contact_n, 0.0);
  EXPECT_EQ(loop.most.excitation_a, kAmplitudeA);
  EXPECT_GT(loop.most.speed_rad_per_s, RpmToRadPerS(2990.0));
}

TEST(ShippedCampaign, WouldBeCutBackByTheLimitThatAScenarioHasWithoutAWord) {
  test::ShippedLoop loop("flexible_rotor", "identify");
  for (auto& step : loop.scenario.steps) {
    if (step.orbit_limit_m > 0.0) step.orbit_limit_m = 0.3 * loop.rig.numbers.clearance_m;
  }
  EXPECT_GT(CutBack(loop), 0U);
}

}  // namespace
}  // namespace levitas

#include "design/gate/gate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/ellipse.hpp"
#include "common/rotational_speed.hpp"
#include "design/search/weight_search.hpp"

namespace levitas::design {
namespace {

struct Files {
  configuration::RigFile rig =
      configuration::LoadRig(configuration::FindConfig("flexible_rotor", "rigs"));
  law::LawConfig law =
      configuration::LoadController(
          configuration::FindConfig("flexible_rotor_commissioned", "controllers"), rig.numbers)
          .law;
};

GateOptions Quick() {
  GateOptions options;
  options.step_rad_per_s = RpmToRadPerS(3000.0);
  options.corners = 1;
  options.draws = 2;
  options.run_speeds_rad_per_s = {0.0, RpmToRadPerS(3000.0)};
  return options;
}

GateResult JudgeQuietly(const Files& files, const law::LawConfig& law, const GateOptions& options) {
  return Judge(files.rig, law, uncertainty::Stated(files.rig, {}), options,
               [](double, const std::string&) {});
}

TEST(DesignGate, AcceptsTheCommissionedLawAndTellsItsFigures) {
  const Files files;
  const GateResult result = JudgeQuietly(files, files.law, Quick());
  EXPECT_TRUE(result.accepted) << result.reason;
  EXPECT_LT(result.pole_modulus, 1.0);
  ASSERT_EQ(result.drawn.size(), 2U);
  EXPECT_LT(result.drawn[0].worst_orbit_m[0], files.rig.numbers.standing_orbit_objective_m);
}

TEST(DesignGate, RefusesALawTooWeakForTheMagnetsAndSaysWhere) {
  Files files;
  // Below ks/ki the magnets pull the rotor away: Earnshaw's instability is not cured.
  for (auto& axis : files.law.axes) {
    axis.kp_a_per_m *= 0.4;
    axis.ki_a_per_m_s = 0.0;
  }
  const GateResult result = JudgeQuietly(files, files.law, Quick());
  EXPECT_FALSE(result.accepted);
  EXPECT_THAT(result.reason, ::testing::HasSubstr("unstable at 0 rpm"));
  EXPECT_EQ(result.drawn[0].lost, 2U);
}

TEST(DesignGate, WritesALostRigThatLoadsAgain) {
  Files files;
  for (auto& axis : files.law.axes) axis.kp_a_per_m *= 0.4;
  const GateResult result = JudgeQuietly(files, files.law, Quick());
  ASSERT_TRUE(result.worst.has_value());
  const std::string text = configuration::WriteRig(*result.worst);
  EXPECT_EQ(configuration::WriteRig(configuration::ParseRig(text, "worst.yaml")), text);
}

TEST(DesignGate, RefusesByEachLimitAlone) {
  const Files files;
  GateOptions options = Quick();
  options.sensitivity = 1.5;
  EXPECT_THAT(JudgeQuietly(files, files.law, options).reason, ::testing::HasSubstr("|S| reaches"));
  options = Quick();
  options.mu = 1.0;
  EXPECT_THAT(JudgeQuietly(files, files.law, options).reason, ::testing::HasSubstr("mu reaches"));
}

// Three times 4800 rpm meets the backward second mode, which the commissioned law leaves at 0.9 %
// damping; the harm, and the law that is made against it.
TEST(DrawnRuns, ThirdHarmonicOnTheSecondModeIsHeldByTheRobustLawOnly) {
  const Files files;
  const double objective_m = files.rig.numbers.spinning_orbit_objective_m;
  const auto run = [&](const law::LawConfig& law, double newtons) {
    return RunOnce(WithThirdHarmonic(files.rig, newtons), law,
                   {.speed_rad_per_s = RpmToRadPerS(4800.0)});
  };
  const RunFigures alone = run(files.law, 0.0);
  ASSERT_FALSE(alone.lost);
  EXPECT_LT(alone.orbit_m[1], objective_m);
  const RunFigures harmed = run(files.law, 0.8);
  EXPECT_TRUE(harmed.lost || harmed.orbit_m[1] > objective_m);
  const auto robust = hinf::DesignHinf(
      files.rig.plant, {}, {.current_limit_a = 1.0, .top_speed_rad_per_s = RpmToRadPerS(6000.0)});
  const RunFigures held = run(robust.law, 0.8);
  ASSERT_FALSE(held.lost);
  EXPECT_LT(held.orbit_m[1], objective_m);
}

TEST(CostOf, PutsAnUnstableLoopBehindEveryStableOne) {
  LoopFigures stable;
  stable.stable = true;
  stable.mu = 9.0;
  stable.sensitivity = 20.0;
  LoopFigures unstable = stable;
  unstable.stable = false;
  unstable.pole_modulus = 1.0001;
  EXPECT_LT(CostOf(stable, {}), CostOf(unstable, {}));
}

TEST(LargestRadius, IsThatOfCirclesLinesAndEllipses) {
  const std::complex<double> j(0.0, 1.0);
  EXPECT_NEAR(LargestRadius(3.0, -3.0 * j), 3.0, 1e-12);  // forward circle
  EXPECT_NEAR(LargestRadius(3.0, 4.0), 5.0, 1e-12);       // a line
  EXPECT_NEAR(LargestRadius(2.0, 1.0 * j), 2.0, 1e-12);   // backward ellipse
}

}  // namespace
}  // namespace levitas::design

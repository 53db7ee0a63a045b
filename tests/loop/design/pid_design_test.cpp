#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "analysis/sensitivity.hpp"
#include "common/problem.hpp"
#include "common/random.hpp"
#include "common/rotational_speed.hpp"
#include "design/pid/pid_search.hpp"
#include "tests/support/shipped_loop.hpp"

namespace levitas::design {
namespace {

configuration::RigFile Rig(const std::string& name) {
  return configuration::LoadRig(configuration::FindConfig(name, "rigs"));
}

constexpr double kLimitA = 1.0;  // of both shipped rigs used here: the bias

PidSearchOptions Quick(std::size_t evaluations) {
  PidSearchOptions options;
  options.evaluations = evaluations;
  options.corners = 2;
  options.current_limit_a = kLimitA;
  return options;
}

PidSearchResult Designed(const configuration::RigFile& rig, const PidLimits& limits,
                         const PidSearchOptions& options) {
  return SearchPid(rig, limits, uncertainty::Stated(rig, {}), options,
                   [](double, const std::string&) { return true; });
}

double LargestPeak(const configuration::RigFile& rig, const law::LawConfig& law, double speed) {
  double peak = 0.0;
  for (const auto& axis : analysis::SensitivityPeaks(rig.plant, law, speed).axes)
    peak = std::max(peak, axis.peak);
  return peak;
}

/// Made once: some seconds.
const PidSearchResult& ForTheFlexibleRotor() {
  static const PidSearchResult found = [] {
    const auto rig = Rig("flexible_rotor");
    return Designed(rig, UsualLimits(rig, kLimitA), Quick(2400));
  }();
  return found;
}

TEST(LawShape, LeavesHeldFiltersWhereTheyAreWhateverTheSearchDraws) {
  LawShape shape;
  shape.bearings = 2;
  shape.axes = 4;
  shape.period_s = 1e-4;
  PlainGains gains{
      .kp_a_per_m = {4e3, 5e3}, .kd_a_s_per_m = {10.0, 15.0}, .notch_hz = {300.0, 900.0}};
  const auto free = static_cast<std::size_t>(StartAt(shape, gains).size());
  shape.lead_lags_at_hz = {510.0};
  shape.notches_at_hz = {730.0};
  Eigen::VectorXd x = StartAt(shape, gains);
  EXPECT_EQ(shape.unknowns(), free - 2);  // of each held filter one
  ASSERT_EQ(static_cast<std::size_t>(x.size()), shape.unknowns());
  const auto plain = LawAt(shape, x).axes[0];
  EXPECT_EQ(plain.lead_lags[0].zero_hz, plain.lead_lags[0].pole_hz);  // does nothing
  EXPECT_EQ(plain.notches[0].zero_damping, plain.notches[0].pole_damping);
  Random draw(3);
  bool leads = false;
  bool lags = false;
  for (int n = 0; n < 50; ++n) {
    for (auto& value : x) value += 0.5 * draw.Normal();
    for (const auto& axis : LawAt(shape, x).axes) {
      const auto& lead = axis.lead_lags[0];
      EXPECT_NEAR(std::sqrt(lead.zero_hz * lead.pole_hz), 510.0, 0.01);
      (lead.zero_hz < lead.pole_hz ? leads : lags) = true;
      EXPECT_EQ(axis.notches[0].frequency_hz, 730.0);
      EXPECT_TRUE(axis.notches[0].prewarp);
      EXPECT_LE(axis.notches[0].zero_damping, axis.notches[0].pole_damping);
      EXPECT_NE(axis.notches[1].frequency_hz, 900.0);
    }
  }
  EXPECT_TRUE(leads && lags);
}

TEST(PidDesign, MeetsItsLimitsAtSpeedsThatAnotherAnalysisTakes) {
  const auto rig = Rig("flexible_rotor");
  const auto& found = ForTheFlexibleRotor();
  EXPECT_LE(found.figures[Limiting(found.figures)].ratio, 1.0);
  for (double rpm = 0.0; rpm <= 6000.0; rpm += 750.0)
    EXPECT_LT(LargestPeak(rig, found.law, RpmToRadPerS(rpm)), 3.0) << rpm << " rpm";  // zone A
}

// The nonlinear rig: contact, current limit, noise, gravity, and every speed on the way.
TEST(PidDesign, RunsTheRigThroughItsWholeSpeedRangeWithinTheObjective) {
  test::ShippedLoop loop("flexible_rotor", "run_up_6000");
  loop.controller.law = ForTheFlexibleRotor().law;
  EXPECT_EQ(loop.Play(1, 60.0), "");
  EXPECT_GT(loop.most.speed_rad_per_s, RpmToRadPerS(5950.0));
  EXPECT_EQ(loop.most.contact_n, 0.0);
  EXPECT_LT(loop.most.orbit_m, Rig("flexible_rotor").numbers.spinning_orbit_objective_m);
}

TEST(PidDesign, IsTheSameForASeedAndAnotherForAnother) {
  const auto rig = Rig("one_axis");
  const auto limits = UsualLimits(rig, kLimitA);
  auto options = Quick(200);
  const auto first = Designed(rig, limits, options);
  EXPECT_EQ(Designed(rig, limits, options).law.axes[0].kp_a_per_m, first.law.axes[0].kp_a_per_m);
  options.seed = 2;
  EXPECT_NE(Designed(rig, limits, options).law.axes[0].kp_a_per_m, first.law.axes[0].kp_a_per_m);
}

TEST(PidDesign, EndedByItsCallerGivesTheBestSoFar) {
  const auto rig = Rig("one_axis");
  std::size_t seen = 0;
  const auto found = SearchPid(rig, UsualLimits(rig, kLimitA), {}, Quick(100'000),
                               [&](double, const std::string&) { return ++seen < 50; });
  EXPECT_TRUE(found.interrupted);
  EXPECT_LT(found.evaluations, 1000U);
  EXPECT_EQ(found.figures.growing, 0);
}

// A limit that no gains can meet is named; the same search with one that they can meets it.
TEST(PidDesign, NamesTheRequirementThatCannotBeMet) {
  const auto rig = Rig("one_axis");
  auto limits = UsualLimits(rig, kLimitA);
  limits[Limit::kNoise] = 1e-6;  // A: the gain that holds the mass at all makes 500 times that
  const auto impossible = Designed(rig, limits, Quick(400));
  EXPECT_EQ(Limiting(impossible.figures), Limit::kNoise);
  EXPECT_GT(impossible.figures[Limit::kNoise].ratio, 1.0);
  limits[Limit::kNoise] = 0.1;
  const auto possible = Designed(rig, limits, Quick(400));
  EXPECT_LE(possible.figures[Limiting(possible.figures)].ratio, 1.0);
}

TEST(PidDesign, RefusesARigWhoseMagnetsCannotCarryIt) {
  auto rig = Rig("one_axis");
  rig.plant.gravity_m_per_s2 = 1000.0;
  try {
    static_cast<void>(Designed(rig, UsualLimits(rig, kLimitA), Quick(100)));
    FAIL() << "designed";
  } catch (const Problem& problem) {
    EXPECT_THAT(problem.what(), ::testing::StartsWith("no law holds this rig: "));
  }
}

// Nothing is known of the flexible modes: with the limit on what an unknown one would need they
// stay damped, without it the same search shakes them loose.
TEST(PidDesign, FirstLevitationLeavesModesDampedThatItDoesNotKnow) {
  const auto rig = Rig("flexible_rotor");
  auto options = Quick(1600);
  options.first_levitation = true;
  auto limits = UsualLimits(rig, kLimitA);
  const auto careless = Designed(rig, limits, options);
  limits[Limit::kAnyMode] = 0.003;  // modal damping of the rig file
  const auto careful = Designed(rig, limits, options);
  EXPECT_FALSE(analysis::SensitivityPeaks(rig.plant, careless.law, 0.0).stable);
  EXPECT_TRUE(analysis::SensitivityPeaks(rig.plant, careful.law, 0.0).stable);
}

// The fourth requirement of a rig that stands without control: the law has to do something.
TEST(PidDesign, StiffensARigThatStandsWithoutControl) {
  const auto rig = Rig("geared_rotor_4dof");
  const auto limits = UsualLimits(rig, kLimitA);
  ASSERT_TRUE(limits[Limit::kCompliance].has_value());
  EXPECT_FALSE(UsualLimits(Rig("flexible_rotor"), kLimitA)[Limit::kCompliance].has_value());
  const auto found = Designed(rig, limits, Quick(1200));
  EXPECT_LE(found.figures[Limiting(found.figures)].ratio, 1.0);
}

}  // namespace
}  // namespace levitas::design

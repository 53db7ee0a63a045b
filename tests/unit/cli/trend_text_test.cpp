// What `amb trend` says of conditions that are known.
#include "cli/commands/trend_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace levitas::cli {
namespace {

using testing::HasSubstr;
using testing::Not;

FollowedSessions WithDrivenWheel(double last_m2) {
  FollowedSessions followed;
  followed.rig = "pair";
  followed.speed_rad_per_s = 182.2123739;
  for (int i = 0; i < 4; ++i) {
    analysis::GearCondition condition;
    condition.speed_rad_per_s = followed.speed_rad_per_s;
    condition.repeats = 12;
    analysis::ShaftCondition wheel;
    wheel.shaft = 1;
    wheel.wheels = "driven wheel of mesh";
    const double each = i == 3 ? last_m2 : 0.0;
    wheel.line_m2.assign(10, 0.1 * each);
    wheel.energy_m2 = {each, 1e-16};
    wheel.once_m = 1e-5;
    condition.shafts = {wheel};
    followed.sessions.push_back({"s.lcm", "s", condition});
  }
  return followed;
}

std::vector<analysis::ShaftTrend> TrendsOf(const FollowedSessions& followed) {
  std::vector<analysis::GearCondition> conditions;
  for (const auto& session : followed.sessions) conditions.push_back(session.condition);
  return analysis::FollowCondition(conditions, followed.rule);
}

TEST(TrendText, NamesTheWheelThatRises) {
  FollowedSessions followed = WithDrivenWheel(1e-14);
  followed.trends = TrendsOf(followed);
  EXPECT_THAT(TrendText(followed), HasSubstr("RISING: driven wheel of mesh, 86.6 deviations above "
                                             "the first 3 sessions, in 10 lines"));
  EXPECT_THAT(TrendText(followed), HasSubstr("1740 rpm"));
  const auto json = TrendJson(followed);
  EXPECT_TRUE(json["trends"][0]["risen"]);
  EXPECT_DOUBLE_EQ(json["sessions"][3]["shafts"][0]["amplitude_m"], 1e-7);
  EXPECT_DOUBLE_EQ(json["trends"][0]["rise_deviations"][3], followed.trends[0].rise[3]);
  const svg::Figure figure = TrendFigure(followed);
  const svg::Series& height = figure.panels.at(0).series.at(2);
  EXPECT_EQ(height.name, "risen from here on");
  EXPECT_LT(height.y.at(0), 0.1);  // the last session, 0.1 um, stands above it
  EXPECT_GT(height.y.at(0), 0.01);
}

TEST(TrendText, OfNoiseSaysThatNothingRises) {
  FollowedSessions followed = WithDrivenWheel(2e-16);
  followed.trends = TrendsOf(followed);
  EXPECT_THAT(TrendText(followed), HasSubstr("no rise: driven wheel of mesh, +1.7 deviations"));
  EXPECT_THAT(TrendText(followed), Not(HasSubstr("RISING")));
}

TEST(TrendText, AccusesNobodyWhereSessionsCannotBeCompared) {
  FollowedSessions followed = WithDrivenWheel(1e-14);
  followed.reasons = {"session 4: its controller file is not that of the first"};
  const std::string text = TrendText(followed);
  EXPECT_THAT(text, HasSubstr("NOT COMPARABLE, so that no rise is said:\n  session 4: its "
                              "controller file"));
  EXPECT_THAT(text, Not(HasSubstr("RISING")));
  EXPECT_FALSE(TrendJson(followed)["comparable"]);
}

TEST(TrendText, OfTwoSessionsClaimsNoInterval) {
  FollowedSessions followed = WithDrivenWheel(1e-14);
  followed.sessions.erase(followed.sessions.begin(), followed.sessions.begin() + 2);
  followed.rule.baseline = 1;
  followed.trends = TrendsOf(followed);
  EXPECT_THAT(TrendText(followed), HasSubstr("above the first session, in 10 lines"));
  EXPECT_THAT(TrendText(followed), HasSubstr("um per session. A pulse"));
  EXPECT_THAT(TrendText(followed), Not(HasSubstr("0 %")));
}

TEST(TrendText, OfTooFewSessionsSaysSo) {
  FollowedSessions followed = WithDrivenWheel(0.0);
  followed.sessions.resize(3);
  EXPECT_THAT(TrendText(followed), HasSubstr("3 sessions say no trend"));
}

}  // namespace
}  // namespace levitas::cli

#include "report/session/verdict_section.hpp"

#include <gmock/gmock.h>

#include <numbers>

namespace levitas::report {
namespace {

using testing::HasSubstr;
using testing::Not;

verdict::Verdict OneOrbit() {
  verdict::Verdict verdict;
  verdict.outcome = verdict::Outcome::kNotAccepted;
  verdict.sentence = "NOT ACCEPTED: de";
  verdict.objections = {"de <wide>"};
  verdict::OrbitJudgement orbit;
  orbit.bearing = "d<e";
  orbit.spinning = true;
  orbit.orbit.max_m = 12.5e-6;
  orbit.objective_m = 7e-6;
  orbit.clearance_share = 0.065;
  verdict.orbits = {orbit};
  verdict.inputs.rig.channels = {"de_x"};
  analysis::SensitivityResult at;
  at.speed_rad_per_s = 100.0 * std::numbers::pi;
  at.axes = {{3.5, 72.0, analysis::Zone::kB, {}}};
  verdict.inputs.sensitivity = {at};
  return verdict;
}

TEST(VerdictSection, HasAnOrbitAndAPeakAsRowsOfTables) {
  const std::string html = VerdictSection(OneOrbit());
  EXPECT_THAT(html, HasSubstr("<td>d&lt;e</td><td>spinning</td><td class=n>12.50</td><td "
                              "class=n>7.00</td><td class=n>6.5</td>"));
  EXPECT_THAT(html, HasSubstr("<td>NO</td>"));
  EXPECT_THAT(html, HasSubstr("<td class=n>3000</td><td>de_x</td><td class=n>3.500</td><td "
                              "class=n>72.0</td><td>B</td><td>-</td>"));
  EXPECT_THAT(html, HasSubstr("<li>de &lt;wide&gt;</li>"));
  EXPECT_LT(html.find("NOT ACCEPTED"), html.find("<table"));
}

TEST(VerdictSection, GivesAnUnstableLoopNoZone) {
  auto verdict = OneOrbit();
  verdict.inputs.sensitivity[0].axes[0].zone.reset();
  EXPECT_THAT(VerdictSection(verdict), HasSubstr("unstable: no grade"));
}

TEST(VerdictSection, ShowsTheMeasuredPeakBesideTheComputedOne) {
  auto verdict = OneOrbit();
  verdict::MeasuredAxis axis;
  axis.channel = "de_x";
  axis.peak = 3.75;
  axis.sigma = 0.02;
  axis.zone = analysis::Zone::kB;
  verdict.inputs.measured =
      verdict::MeasuredSensitivity{{{verdict.inputs.sensitivity[0].speed_rad_per_s, {axis}}}, ""};
  EXPECT_THAT(VerdictSection(verdict), HasSubstr("3.75 ± 0.02, zone B"));
}

TEST(CriticalSpeedSection, ListsCrossingsAndSaysWhereThereAreNone) {
  EXPECT_EQ(CriticalSpeedSection(std::nullopt), "");
  analysis::Campbell campbell;
  campbell.speeds.push_back({200.0 * std::numbers::pi, {}});
  EXPECT_THAT(CriticalSpeedSection(campbell), HasSubstr("6000 rpm"));
  EXPECT_THAT(CriticalSpeedSection(campbell), HasSubstr("None."));
  campbell.crossings.push_back({100.0 * std::numbers::pi, {50.0, 0.125, 1.0, 0.0}});
  const std::string html = CriticalSpeedSection(campbell);
  EXPECT_THAT(html, HasSubstr("<td class=n>3000</td><td class=n>50.00</td><td "
                              "class=n>0.1250</td><td class=n>4.0</td><td>forward</td>"));
  EXPECT_THAT(html, Not(HasSubstr("None.")));
}

}  // namespace
}  // namespace levitas::report

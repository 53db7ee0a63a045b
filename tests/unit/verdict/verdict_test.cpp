#include "verdict/verdict.hpp"
#include "common/rotational_speed.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "tests/unit/verdict/synthetic_session.hpp"
#include "verdict/report.hpp"

namespace levitas::verdict {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

Inputs RunWith(double standing_m, double spinning_m) {
  SyntheticSession session;
  session.Append(Mode::kLevitating, 400, {.radius_m = standing_m});
  session.Append(Mode::kSpinning, 400,
                 {.radius_m = spinning_m, .speed_rad_per_s = RpmToRadPerS(2870.0)});
  Inputs inputs;
  inputs.rig = TwoBearingRig();
  inputs.session = session.Figures(inputs.rig);
  return inputs;
}

analysis::SensitivityResult Loop(double peak, bool stable = true) {
  analysis::SensitivityResult result;
  result.stable = stable;
  result.speed_rad_per_s = RpmToRadPerS(100.0);
  result.axes.resize(4);
  for (auto& axis : result.axes) {
    axis.peak = 2.0;
    if (stable) axis.zone = analysis::Zone::kA;
  }
  result.axes[3].peak = peak;
  if (stable && peak >= 4.0) result.axes[3].zone = peak < 5.0 ? Zone::kC : Zone::kD;
  return result;
}

TEST(Judge, AcceptsARunInsideEveryObjective) {
  const Verdict verdict = Judge(RunWith(4e-6, 20e-6));
  EXPECT_EQ(verdict.outcome, Outcome::kAccepted);
  EXPECT_EQ(verdict.sentence,
            "ACCEPTED up to 2870 rpm: orbit standing 4.0 um of 7.0 um allowed (zone A), spinning "
            "20.0 um of 36.0 "
            "um allowed (zone A)");
  EXPECT_EQ(verdict.orbits.size(), 4U);
  EXPECT_TRUE(verdict.objections.empty());
}

TEST(Judge, NamesBearingOrbitLimitAndSpeedOfWhatItRefuses) {
  Inputs inputs = RunWith(4e-6, 20e-6);
  inputs.session.spinning.bearings[1].orbit.max_m = 41e-6;
  const Verdict verdict = Judge(inputs);
  EXPECT_EQ(verdict.outcome, Outcome::kNotAccepted);
  EXPECT_EQ(verdict.sentence,
            "NOT ACCEPTED: nde orbit 41.0 um while spinning exceeds 36.0 um at 2870 rpm");
}

TEST(Judge, GradesEachBearingByItsOwnClearance) {
  Inputs inputs = RunWith(4e-6, 20e-6);
  inputs.rig.spinning_orbit_objective_m = 150e-6;
  inputs.rig.clearances_m = {200e-6, 400e-6};
  for (auto& bearing : inputs.session.spinning.bearings) bearing.orbit.max_m = 100e-6;
  const Verdict verdict = Judge(inputs);
  ASSERT_EQ(verdict.orbits.size(), 4U);
  EXPECT_EQ(verdict.orbits[2].zone, Zone::kD);  // half of 200 um
  EXPECT_EQ(verdict.orbits[3].zone, Zone::kA);  // a quarter of 400 um
}

TEST(Judge, HoldsStandingAndSpinningAgainstTheirOwnObjective) {
  const Verdict verdict = Judge(RunWith(8e-6, 20e-6));
  ASSERT_EQ(verdict.objections.size(), 2U);  // both bearings
  EXPECT_EQ(verdict.objections[0], "de orbit 8.0 um while standing exceeds 7.0 um");
}

TEST(Judge, AnOrbitOnTheObjectiveIsNotBelowIt) {
  Inputs inputs = RunWith(4e-6, 20e-6);
  inputs.session.standing.bearings[0].orbit.max_m = inputs.rig.standing_orbit_objective_m;
  EXPECT_EQ(Judge(inputs).outcome, Outcome::kNotAccepted);
}

// 90 um of a clearance of 200 um is 0.45: zone C; the objective is set high to see the zone alone.
TEST(Judge, RefusesZoneCOfTheClearanceEvenInsideTheObjective) {
  Inputs inputs = RunWith(4e-6, 90e-6);
  inputs.rig.spinning_orbit_objective_m = 100e-6;
  const Verdict verdict = Judge(inputs);
  EXPECT_EQ(verdict.outcome, Outcome::kNotAccepted);
  EXPECT_THAT(verdict.sentence, HasSubstr("de displacement of 0.45 clearances while spinning is "
                                          "zone C at 2870 rpm"));
}

TEST(Judge, GradesSensitivityAndRefusesZoneC) {
  Inputs inputs = RunWith(4e-6, 20e-6);
  inputs.sensitivity = {Loop(2.5)};
  EXPECT_EQ(Judge(inputs).outcome, Outcome::kAccepted);
  inputs.sensitivity = {Loop(4.2)};
  EXPECT_EQ(Judge(inputs).sentence,
            "NOT ACCEPTED: computed sensitivity peak of nde_y is 4.20 at 100 rpm, zone C");
}

TEST(Judge, NamesTheLargestOfSeveralPeaksInTheSentenceAndListsThemAll) {
  Inputs inputs = RunWith(4e-6, 20e-6);
  inputs.sensitivity = {Loop(4.2), Loop(4.4), Loop(4.3)};
  const Verdict verdict = Judge(inputs);
  EXPECT_EQ(verdict.objections.size(), 3U);
  EXPECT_EQ(verdict.sentence,
            "NOT ACCEPTED: computed sensitivity peak of nde_y is 4.40 at 100 rpm, zone C (the "
            "largest of 3 such peaks)");
}

TEST(Judge, GivesAnUnstableLoopNoGradeAndNoAcceptance) {
  Inputs inputs = RunWith(4e-6, 20e-6);
  inputs.sensitivity = {Loop(2.5, false)};
  const Verdict verdict = Judge(inputs);
  EXPECT_EQ(verdict.sentence, "NOT ACCEPTED: the linear loop is unstable at 100 rpm");
}

TEST(Judge, DoesNotAcceptWhatNeverLevitated) {
  SyntheticSession session;
  session.Append(Mode::kOff, 100);
  Inputs inputs;
  inputs.rig = TwoBearingRig();
  inputs.session = session.Figures(inputs.rig);
  EXPECT_THAT(Judge(inputs).sentence,
              StartsWith("NOT ACCEPTED: the rotor was not levitated for longer"));
}

TEST(Judge, SaysThatAPhaseWasNotRun) {
  SyntheticSession session;
  session.Append(Mode::kLevitating, 400, {.radius_m = 1e-6});
  Inputs inputs;
  inputs.rig = TwoBearingRig();
  inputs.session = session.Figures(inputs.rig);
  const Verdict verdict = Judge(inputs);
  EXPECT_EQ(verdict.outcome, Outcome::kAccepted);
  EXPECT_THAT(verdict.sentence, HasSubstr("spinning not run"));
}

TEST(Judge, ATripStandsBeforeEveryOtherVerdict) {
  Inputs inputs = RunWith(8e-6, 20e-6);
  inputs.incomplete_reason = "interrupted";
  inputs.session.trip = TripFigures{Fault::kOrbitExceeded, 2, 99e-6, 95e-6, 1.25, Mode::kSpinning,
                                    RpmToRadPerS(100.0)};
  const Verdict silent = Judge(inputs);
  EXPECT_EQ(silent.outcome, Outcome::kTripped);
  EXPECT_EQ(silent.sentence,
            "TRIPPED: orbit_exceeded on nde_x: 9.9e-05, allowed 9.5e-05. (It was in mode spinning "
            "at 100 rpm, "
            "1.250 s after the start.)");
  inputs.trip_text = "TRIP in cycle 12: the orbit is too large.";
  EXPECT_THAT(Judge(inputs).sentence,
              StartsWith("TRIPPED in cycle 12: the orbit is too large. (It was in mode"));
}

TEST(Judge, ARunCutShortIsIncompleteNotAccepted) {
  Inputs inputs = RunWith(4e-6, 20e-6);
  inputs.incomplete_reason = "step 3 of the scenario timed out";
  const Verdict verdict = Judge(inputs);
  EXPECT_EQ(verdict.outcome, Outcome::kIncomplete);
  EXPECT_EQ(verdict.sentence, "INCOMPLETE: step 3 of the scenario timed out");
}

TEST(Outcome, HasStableNames) {
  EXPECT_EQ(Name(Outcome::kAccepted), "accepted");
  EXPECT_EQ(Name(Outcome::kNotAccepted), "not_accepted");
  EXPECT_EQ(Name(Outcome::kTripped), "tripped");
  EXPECT_EQ(Name(Outcome::kIncomplete), "incomplete");
}

// nde_y at the speed of Loop(): what the test signals say of it.
MeasuredSensitivity Measured(double peak, double computed, std::optional<Zone> zone) {
  MeasuredAxis axis{"nde_y",  peak, 0.02, peak, 40.0, zone, zone ? "" : "too few lines",
                    computed, false};
  axis.differs = zone && std::abs(computed - peak) > 0.2 * peak;
  return {{{RpmToRadPerS(100.0), {axis}}}, ""};
}

TEST(JudgeMeasured, AMeasuredPeakCountsInsteadOfTheComputedOneOfItsAxisAndSpeed) {
  Inputs inputs = RunWith(4e-6, 20e-6);
  inputs.sensitivity = {Loop(4.2)};
  ASSERT_EQ(Judge(inputs).outcome, Outcome::kNotAccepted);
  inputs.measured = Measured(3.9, 4.2, Zone::kB);
  EXPECT_EQ(Judge(inputs).outcome, Outcome::kAccepted);
  inputs.sensitivity[0].speed_rad_per_s *= 2.0;  // there, nothing was measured
  EXPECT_EQ(Judge(inputs).outcome, Outcome::kNotAccepted);
}

TEST(JudgeMeasured, AMeasuredPeakBeyondZoneBIsAnObjectionWhateverWasComputed) {
  Inputs inputs = RunWith(4e-6, 20e-6);
  inputs.sensitivity = {Loop(2.5)};
  inputs.measured = Measured(4.3, 2.5, Zone::kC);
  EXPECT_EQ(Judge(inputs).sentence,
            "NOT ACCEPTED: measured sensitivity peak of nde_y is 4.30 at 100 rpm, zone C");
}

TEST(JudgeMeasured, APeakThatTheLinesDoNotCarryChangesNothing) {
  Inputs inputs = RunWith(4e-6, 20e-6);
  inputs.sensitivity = {Loop(4.2)};
  inputs.measured = Measured(2.0, 4.2, std::nullopt);
  EXPECT_EQ(Judge(inputs).outcome, Outcome::kNotAccepted);
  EXPECT_TRUE(Judge(inputs).warnings.empty());
}

TEST(JudgeMeasured, WarnsBeyondTwentyPercentInTableAndJsonAndNotWithin) {
  Inputs inputs = RunWith(4e-6, 20e-6);
  inputs.sensitivity = {Loop(2.5)};
  inputs.measured = Measured(2.9, 2.5, Zone::kA);
  EXPECT_TRUE(Judge(inputs).warnings.empty());
  inputs.measured = Measured(3.5, 2.5, Zone::kB);
  const Verdict verdict = Judge(inputs);
  EXPECT_EQ(verdict.outcome, Outcome::kAccepted);
  ASSERT_EQ(verdict.warnings.size(), 1U);
  EXPECT_THAT(verdict.warnings[0], StartsWith("sensitivity peak of nde_y at 100 rpm: measured "
                                              "3.50, computed 2.50, 29 % apart"));
  EXPECT_THAT(Table(verdict), HasSubstr("WARNING: " + verdict.warnings[0]));
  EXPECT_THAT(Table(verdict), HasSubstr("measured, sigma 0.020"));
  const auto json = Json(verdict);
  EXPECT_EQ(json["warnings"], nlohmann::ordered_json(verdict.warnings));
  EXPECT_EQ(json["sensitivity"][1]["source"], "measured");
  EXPECT_EQ(json["sensitivity"][1]["axes"][0]["peak"], 3.5);
}

}  // namespace
}  // namespace levitas::verdict

// What `amb run` names as the next command.

#include "cli/commands/next_step.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "verdict/verdict.hpp"

namespace levitas::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// Of a loop whose largest |S| lies in this zone.
verdict::Verdict RunIn(analysis::Zone zone, verdict::Outcome outcome) {
  verdict::Verdict verdict;
  verdict.outcome = outcome;
  analysis::SensitivityResult at;
  at.stable = true;
  at.axes.push_back({.peak = 6.0, .frequency_hz = 90.0, .zone = zone, .margins = {}});
  verdict.inputs.sensitivity.push_back(at);
  return verdict;
}

TEST(NextStep, NamesTheDesignWhereTheLoopIsPoor) {
  EXPECT_THAT(
      NextStep(RunIn(analysis::Zone::kD, verdict::Outcome::kNotAccepted), {.rig = "my.yaml"}),
      AllOf(HasSubstr("amb margins --rig 'my.yaml' shows"),
            HasSubstr("amb design pid --rig 'my.yaml' --out pid")));
}

TEST(NextStep, NamesTheDesignWhereTheOrbitIsTooLarge) {
  verdict::Verdict verdict = RunIn(analysis::Zone::kA, verdict::Outcome::kNotAccepted);
  verdict.orbits.push_back({.bearing = "de", .spinning = true, .orbit = {}, .met = false});
  EXPECT_THAT(NextStep(verdict, {.rig = "my.yaml"}), HasSubstr("amb design pid"));
}

TEST(NextStep, IsSilentWhereALawWouldNotHelp) {
  EXPECT_EQ(NextStep(RunIn(analysis::Zone::kA, verdict::Outcome::kAccepted), {.rig = "my.yaml"}),
            "");
  // Refused for something else: the amplifiers went off, say.
  EXPECT_EQ(NextStep(RunIn(analysis::Zone::kB, verdict::Outcome::kNotAccepted), {.rig = "my.yaml"}),
            "");
  EXPECT_EQ(NextStep(RunIn(analysis::Zone::kD, verdict::Outcome::kTripped), {.rig = "my.yaml"}),
            "");
}

TEST(NextStep, IsAboutTheLawThatWasRunAndSilentAboutAnotherBias) {
  const verdict::Verdict verdict = RunIn(analysis::Zone::kD, verdict::Outcome::kNotAccepted);
  EXPECT_THAT(NextStep(verdict, {.rig = "r", .controller = "soft.yaml"}),
              HasSubstr("amb margins --rig 'r' --controller 'soft.yaml'"));
  EXPECT_EQ(NextStep(verdict, {.rig = "r", .other_rig = true}), "");
}

/// The orbit that a test signal makes says nothing of the law.
TEST(NextStep, BlamesNoLawForTheOrbitOfATestSignal) {
  verdict::Verdict verdict = RunIn(analysis::Zone::kA, verdict::Outcome::kNotAccepted);
  verdict.orbits.push_back({.bearing = "de", .spinning = false, .orbit = {}, .met = false});
  verdict.inputs.measured.emplace();
  EXPECT_THAT(NextStep(verdict, {.rig = "r"}),
              AllOf(HasSubstr("--record FILE"), Not(HasSubstr("design"))));
}

TEST(NextStep, SaysWhatARecordOfTestSignalsIsFor) {
  verdict::Verdict verdict = RunIn(analysis::Zone::kD, verdict::Outcome::kNotAccepted);
  verdict.inputs.measured.emplace();
  EXPECT_THAT(
      NextStep(verdict, {.rig = "my.yaml", .record = "id.lcm"}),
      AllOf(HasSubstr("amb identify modal 'id.lcm'"), HasSubstr("amb diagnose 'id.lcm' --out")));
}

}  // namespace
}  // namespace levitas::cli

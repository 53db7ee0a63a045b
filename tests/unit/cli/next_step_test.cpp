// What `amb run` names as the next command.

#include "cli/commands/next_step.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "verdict/verdict.hpp"

namespace levitas::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;

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
  EXPECT_THAT(NextStep(RunIn(analysis::Zone::kD, verdict::Outcome::kNotAccepted), "my.yaml", ""),
              AllOf(HasSubstr("amb margins --rig my.yaml"),
                    HasSubstr("amb design pid --rig my.yaml --out pid.yaml")));
}

TEST(NextStep, NamesTheDesignWhereTheOrbitIsTooLarge) {
  verdict::Verdict verdict = RunIn(analysis::Zone::kA, verdict::Outcome::kNotAccepted);
  verdict.orbits.push_back({.bearing = "de", .spinning = true, .orbit = {}, .met = false});
  EXPECT_THAT(NextStep(verdict, "my.yaml", ""), HasSubstr("amb design pid"));
}

TEST(NextStep, IsSilentWhereALawWouldNotHelp) {
  EXPECT_EQ(NextStep(RunIn(analysis::Zone::kA, verdict::Outcome::kAccepted), "my.yaml", ""), "");
  // Refused for something else: the amplifiers went off, say.
  EXPECT_EQ(NextStep(RunIn(analysis::Zone::kB, verdict::Outcome::kNotAccepted), "my.yaml", ""), "");
  EXPECT_EQ(NextStep(RunIn(analysis::Zone::kD, verdict::Outcome::kTripped), "my.yaml", ""), "");
}

TEST(NextStep, SaysWhatARecordOfTestSignalsIsFor) {
  verdict::Verdict verdict = RunIn(analysis::Zone::kD, verdict::Outcome::kNotAccepted);
  verdict.inputs.measured.emplace();
  EXPECT_THAT(NextStep(verdict, "my.yaml", "id.lcm"),
              AllOf(HasSubstr("amb identify modal id.lcm"), HasSubstr("amb diagnose id.lcm")));
}

}  // namespace
}  // namespace levitas::cli

// What separates tied causes, in words and as a scenario.

#include "diagnosis/levitator/plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/levitator/rig.hpp"

namespace levitas::levitator {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

diagnosis::DiagnosisReport Tied(const std::string& cause, const std::vector<std::string>& others) {
  diagnosis::DiagnosisReport answer;
  answer.verdict = diagnosis::Verdict::kEffect;
  answer.ties = {{cause, others}};
  return answer;
}

scenario::ScenarioConfig Read(const std::string& text) {
  return configuration::ParseScenario(text, "next.yaml", test::LevitatorFile().numbers);
}

TEST(LevitatorPlan, LeadsTheBallOverItsStrokeForWhatGoesByTheGap) {
  const diagnosis::DiagnosisReport answer = Tied("inductance_profile", {"coil_inductance"});
  const auto file = test::LevitatorFile();
  const auto plan = Read(PlanScenario(file, answer));
  ASSERT_EQ(plan.steps.size(), 3U);  // lift, led, land
  ASSERT_EQ(plan.steps[1].excitation.size(), 2U);
  const scenario::Excitation& led = plan.steps[1].excitation[0];
  EXPECT_EQ(led.point, scenario::Injection::kMeasuredPosition);
  // Slower than the loop follows, further than the shipped scenario goes, within the clearance.
  EXPECT_LT(led.to_hz, 2.0);
  EXPECT_GT(led.amplitude_m, 1e-3);
  EXPECT_LT(led.amplitude_m, 0.5 * file.plant.bearings[0].touchdown.clearance_m);
  EXPECT_EQ(plan.steps[1].excitation[1].point, scenario::Injection::kControlCurrent);
}

TEST(LevitatorPlan, ShakesTheBallForALoadAndSaysWhy) {
  const diagnosis::DiagnosisReport answer = Tied("static_load", {"rotor_mass"});
  const std::string text = PlanScenario(test::LevitatorFile(), answer);
  EXPECT_EQ(Read(text).steps.size(), 3U);
  EXPECT_THAT(Separations(answer), ElementsAre(StartsWith("static_load from rotor_mass: ")));
  EXPECT_THAT(text, HasSubstr("# " + Separations(answer).front()));
}

TEST(LevitatorPlan, WritesNoScenarioForWhatNoRecordCanTell) {
  const diagnosis::DiagnosisReport answer = Tied("rotor_mass", {"force_constant"});
  EXPECT_EQ(PlanScenario(test::LevitatorFile(), answer), "");
  EXPECT_THAT(Separations(answer), ElementsAre(HasSubstr("weighed")));
}

TEST(LevitatorPlan, TellsOnceWhatSeparatesSeveralAndWhatOfThemNothingDoes) {
  const auto words = Separations(Tied("static_load", {"rotor_mass", "force_constant"}));
  EXPECT_THAT(words, ElementsAre(StartsWith("static_load from rotor_mass, force_constant: "),
                                 StartsWith("rotor_mass from force_constant: ")));
}

TEST(LevitatorPlan, HasNothingToSeparateWithoutATie) {
  EXPECT_TRUE(Separations(Tied("static_load", {})).empty());
  EXPECT_EQ(PlanScenario(test::LevitatorFile(), Tied("static_load", {})), "");
}

TEST(LevitatorPlan, DoesAllItCanForARemainderWithoutAName) {
  diagnosis::DiagnosisReport answer;
  answer.verdict = diagnosis::Verdict::kUnknown;
  EXPECT_EQ(Read(PlanScenario(test::LevitatorFile(), answer)).steps.size(), 5U);
  EXPECT_EQ(Separations(answer).size(), 1U);
}

TEST(LevitatorPlan, AlsoHasAWayForCausesThatItDoesNotKnowTogether) {
  const diagnosis::DiagnosisReport answer = Tied("coil_heating", {"mutual_inductance"});
  EXPECT_EQ(Read(PlanScenario(test::LevitatorFile(), answer)).steps.size(), 5U);
}

}  // namespace
}  // namespace levitas::levitator

// The scenario that would separate what the data could not.

#include "diagnosis/report/plan.hpp"

#include <gtest/gtest.h>

#include "config/rig_file.hpp"

namespace levitas::diagnosis {
namespace {

DiagnosisResult Tie(const std::string& first, const std::string& second,
                    const std::string& name = "flexible_rotor") {
  DiagnosisResult s;
  const auto rig = config::LoadRig(config::FindConfig(name, "rigs"));
  s.view = std::make_shared<const RigView>(rig.numbers, rig.plant);
  Hypothesis cause;
  cause.effect = first;
  s.answer.verdict = Verdict::kEffect;
  s.answer.causes = {cause};
  s.answer.also_possible = {second};
  return s;
}

std::size_t Count(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(Plan, ForCausesInTheLoopExcitesEveryAxisAndDoesNotTurn) {
  const std::string text = PlanScenario(Tie("extra_delay", "amplifier_bandwidth"));
  EXPECT_EQ(Count(text, "excitation:"), 4U);
  EXPECT_EQ(Count(text, "divisor: 1}"), 4U) << "they differ at high frequency";
  EXPECT_EQ(Count(text, "do: spin"), 0U);
}

TEST(Plan, ForCausesOfTheRotationRollsSlowlyAndRunsUpToNearTheRatedSpeed) {
  const std::string text = PlanScenario(Tie("unbalance", "shaft_bow"));
  // 6000 rpm rated: 8, 50, 95 % of it, and back to rest.
  for (const char* speed :
       {"speed_rpm: 480\n", "speed_rpm: 3000\n", "speed_rpm: 5700\n", "speed_rpm: 0\n"}) {
    EXPECT_EQ(Count(text, speed), 1U) << speed << text;
  }
}

TEST(Plan, ForCausesInTheTeethTurnsTheGears) {
  const std::string text = PlanScenario(Tie("tooth_crack", "mesh_stiffness", "geared_rotor_4dof"));
  EXPECT_EQ(Count(text, "do: spin"), 4U) << text;
}

TEST(Plan, SaysWhatItIsFor) {
  EXPECT_NE(PlanScenario(Tie("unbalance", "shaft_bow")).find("# To separate"), std::string::npos);
}

}  // namespace
}  // namespace levitas::diagnosis

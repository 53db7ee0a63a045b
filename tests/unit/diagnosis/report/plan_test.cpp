// The scenario that would separate what the data could not.

#include "diagnosis/report/plan.hpp"

#include <gtest/gtest.h>

#include "configuration/rig_file.hpp"

namespace levitas::diagnosis {
namespace {

/// The scenario for a cause and one that the data do not separate from it.
std::string PlanOfTie(const std::string& cause, const std::string& other,
                      const std::string& rig = "flexible_rotor") {
  DiagnosisReport report;
  report.verdict = Verdict::kEffect;
  report.causes = {{cause, ""}};
  report.also_possible = {other};
  return PlanScenario(report, configuration::LoadRig(configuration::FindConfig(rig, "rigs")));
}

std::size_t Count(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(Plan, ForCausesInTheLoopExcitesEveryAxisAndDoesNotTurn) {
  const std::string text = PlanOfTie("extra_delay", "amplifier_bandwidth");
  EXPECT_EQ(Count(text, "excitation:"), 4U);
  EXPECT_EQ(Count(text, "divisor: 1}"), 4U) << "they differ at high frequency";
  EXPECT_EQ(Count(text, "do: spin"), 0U);
}

TEST(Plan, ForCausesOfTheRotationRollsSlowlyAndRunsUpToNearTheRatedSpeed) {
  const std::string text = PlanOfTie("unbalance", "shaft_bow");
  // 6000 rpm rated: 8, 50, 95 % of it, and back to rest.
  for (const char* speed :
       {"speed_rpm: 480\n", "speed_rpm: 3000\n", "speed_rpm: 5700\n", "speed_rpm: 0\n"}) {
    EXPECT_EQ(Count(text, speed), 1U) << speed << text;
  }
}

TEST(Plan, ForCausesInTheTeethTurnsTheGears) {
  const std::string text = PlanOfTie("tooth_crack", "mesh_stiffness", "geared_rotor_4dof");
  EXPECT_EQ(Count(text, "do: spin"), 4U) << text;
}

TEST(Plan, SaysWhatItIsFor) {
  EXPECT_NE(PlanOfTie("unbalance", "shaft_bow").find("# To separate"), std::string::npos);
}

}  // namespace
}  // namespace levitas::diagnosis

// One hidden effect in a geared rig and one in the pump: named, and the extended rig can be read.

#include <gtest/gtest.h>

#include "benchmark/accuracy/scores.hpp"
#include "diagnosis/report/build_report.hpp"
#include "diagnosis/report/extended_rig.hpp"

namespace levitas::accuracy {
namespace {

struct Asked {
  TestRig bench;
  diagnosis::DiagnosisResult answer;
  TrialScore outcome;
};

Asked AskOn(const std::string& rig, std::uint64_t seed, std::vector<effect::Id> hidden) {
  Asked asked{LoadTestRig(rig, {}), {}, {}};
  TrialPlan plan;
  plan.seed = seed;
  plan.hidden = std::move(hidden);
  plan.bits_per_axis = 750;
  plan.runup_s = 1.0;
  const Trial trial = MakeTrial(asked.bench, plan);
  diagnosis::Settings settings;
  settings.quick = true;
  settings.most_causes = 1;
  asked.answer = diagnosis::DiagnoseRecords(asked.bench.rig, trial.records, {}, settings);
  asked.outcome = Judge(plan, trial.ground_truth, diagnosis::BuildReport(asked.answer));
  return asked;
}

/// The extended rig holds the cause as an effect that the strict reader takes.
void ExpectReadable(const Asked& asked, effect::Id id) {
  const std::string text = diagnosis::ExtendedRig(asked.answer, asked.bench.rig);
  const configuration::RigFile extended = configuration::ParseRig(text, "extended_rig.yaml");
  ASSERT_EQ(extended.plant.effects.size(), 1U);
  EXPECT_EQ(extended.plant.effects.front().id, id);
}

TEST(GearedRig, WithACrackedToothIsSaidToHaveOne) {
  const Asked asked = AskOn("geared_rotor_4dof", 21006, {effect::Id::kToothCrack});
  EXPECT_TRUE(asked.outcome.Right()) << asked.outcome.verdict;
  ExpectReadable(asked, effect::Id::kToothCrack);
}

TEST(GearedRig, WithNothingHiddenIsSaidToHaveNothing) {
  EXPECT_EQ(AskOn("geared_rotor_4dof", 21008, {}).outcome.verdict, "none");
}

TEST(Pump, WithALateLoopIsSaidToBeLate) {
  const Asked asked = AskOn("turbomolecular_pump", 20002, {effect::Id::kExtraDelay});
  EXPECT_TRUE(asked.outcome.Right()) << asked.outcome.verdict;
  ExpectReadable(asked, effect::Id::kExtraDelay);
}

}  // namespace
}  // namespace levitas::accuracy

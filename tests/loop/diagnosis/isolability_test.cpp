// Predictions of what records can show, against cases that are known and against a diagnosis.

#include <gtest/gtest.h>

#include <algorithm>

#include "benchmark/accuracy/agreement.hpp"
#include "benchmark/accuracy/scores.hpp"
#include "diagnosis/isolability/foretell.hpp"
#include "diagnosis/isolability/simulated_record.hpp"
#include "diagnosis/records/levitated_interval.hpp"
#include "diagnosis/report/build_report.hpp"

namespace levitas::accuracy {
namespace {

using diagnosis::Isolation;
using effect::Id;

TrialPlan Plan(std::uint64_t seed, std::vector<Id> hidden) {
  TrialPlan plan;
  plan.seed = seed;
  plan.hidden = std::move(hidden);
  plan.bits_per_axis = 750;
  plan.runup_s = 1.0;
  return plan;
}

/// Kind foretold from the records without the effect, and that of a first answer on those with it.
void ExpectForetold(std::uint64_t seed, Id hidden) {
  const TestRig bench = LoadTestRig("flexible_rotor", {"flexible_rotor"});
  const Trial healthy = MakeTrial(bench, Plan(seed, {}));
  const TrialPlan plan = Plan(seed, {hidden});
  const Trial trial = MakeTrial(bench, plan);
  const diagnosis::Judging judging;
  const diagnosis::HealthyModel model(bench.rig, healthy.records, true, judging);
  const auto foretold = Foretell(model, nullptr, trial.ground_truth.hidden, judging);
  ASSERT_TRUE(foretold);
  diagnosis::Settings settings;
  settings.quick = true;
  const TrialScore answer = Judge(
      plan, trial.ground_truth,
      diagnosis::BuildReport(diagnosis::DiagnoseRecords(bench.rig, trial.records, {}, settings)));
  const auto named = NamedOrTied(answer.verdict, answer.named, answer.ties);
  EXPECT_EQ(KindOf(trial.ground_truth.effects.front(), named), foretold->isolation)
      << answer.verdict << ", foretold " << Word(foretold->isolation) << " with "
      << foretold->evidence_nat << " nat";
}

TEST(Isolability, AClearGainIsForetoldAndAnsweredAlike) { ExpectForetold(5104, Id::kCurrentGain); }

TEST(Isolability, WhatTolerancesHideIsForetoldAndAnsweredAlike) {
  ExpectForetold(5105, Id::kAmplifierSlew);
}

class Standing : public testing::Test {
 protected:
  /// Half a second at rest without a test signal, then at a speed.
  static diagnosis::Record Recorded(double rpm) {
    const std::string turning =
        rpm > 0.0 ? "  - {do: spin, speed_rpm: " + std::to_string(rpm) +
                        ", acceleration_rpm_per_s: 2000, until: speed_reached, timeout_s: 9, "
                        "hold_s: 1}\n  - {do: spin, speed_rpm: 0, acceleration_rpm_per_s: 2000, "
                        "until: standstill, timeout_s: 9}\n"
                  : "";
    const auto rig = Rig();
    const auto controller = configuration::LoadController(
        configuration::FindConfig("flexible_rotor", "controllers"), rig.numbers);
    const auto scenario = configuration::ParseScenario(
        "kind: scenario\nname: test\nsteps:\n"
        "  - {do: lift, until: levitating, timeout_s: 9, hold_s: 1.5}\n" +
            turning + "  - {do: land, until: 'off', timeout_s: 9}\n",
        "test.yaml", rig.numbers);
    diagnosis::Record record = diagnosis::SimulatedRecord(rig, controller, scenario, 1);
    diagnosis::LeaveOutContact(diagnosis::RigView(rig.numbers, rig.plant), record);
    return record;
  }
  static configuration::RigFile Rig() {
    return LoadTestRig("flexible_rotor", {"flexible_rotor"}).rig;
  }
};

TEST_F(Standing, ShowsNoUnbalanceAndTurningBesideItDoes) {
  const diagnosis::Judging judging;
  const diagnosis::HealthyModel at_rest(Rig(), {Recorded(0.0)}, false, judging);
  const auto fault = diagnosis::StatedFaultOf(Id::kUnbalance, at_rest.rig());
  ASSERT_TRUE(fault);
  const auto hidden = Foretell(at_rest, nullptr, {fault->entry}, judging);
  EXPECT_EQ(hidden->isolation, Isolation::kNotVisible);
  EXPECT_NEAR(hidden->detectable_nat, 0.0, 1e-3) << "nothing turns";
  const diagnosis::HealthyModel turning(Rig(), {Recorded(3000.0)}, false, judging,
                                        at_rest.orbit_m());
  const auto both = Foretell(at_rest, &turning, {fault->entry}, judging);
  EXPECT_NE(both->isolation, Isolation::kNotVisible);
  const auto alone = Foretell(turning, nullptr, {fault->entry}, judging);
  EXPECT_LT(alone->detectable_nat, 1.3 * both->detectable_nat) << "rest adds next to nothing";
}

TEST_F(Standing, ASensorsOffsetWithinItsToleranceIsTakenByCalibration) {
  const diagnosis::Judging judging;
  const diagnosis::HealthyModel model(Rig(), {Recorded(0.0)}, false, judging);
  auto fault = diagnosis::StatedFaultOf(Id::kSensorOffset, model.rig());
  ASSERT_TRUE(fault);
  // As large as its tolerance of 10 um, which costs half a nat; the operating point moves too.
  fault->entry.values[0] = 10e-6;
  const auto hidden = Foretell(model, nullptr, {fault->entry}, judging);
  EXPECT_EQ(hidden->isolation, Isolation::kNotVisible);
  EXPECT_LT(hidden->detectable_nat, 3.0);
}

}  // namespace
}  // namespace levitas::accuracy

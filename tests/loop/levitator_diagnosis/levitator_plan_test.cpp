// A tie that the shipped scenario leaves, and the plan that separates it, played on the same rig.

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "diagnosis/levitator/levitator_result.hpp"
#include "diagnosis/levitator/plan.hpp"
#include "tests/support/effect_entry.hpp"
#include "tests/support/shipped_loop.hpp"

namespace levitas::test {
namespace {

ShippedLoop Levitator() { return ShippedLoop("two_magnet_levitator", "two_magnet_levitator"); }

/// Plays what a loop holds, without measured currents, and diagnoses it by the shipped rig file.
diagnosis::DiagnosisReport Ask(ShippedLoop& loop) {
  std::vector<analysis::RecordedRow> rows;
  EXPECT_EQ(loop.Play(7, 60.0,
                      [&](const cycle::CycleRecord& record) {
                        analysis::RecordedRow row;
                        row.cycle = record.in.cycle;
                        row.levitated = true;
                        row.sample.position_m = record.in.frame.position_m;
                        row.sample.command = plant::CommandOf(record.out.current);
                        rows.push_back(row);
                      }),
            "");
  EXPECT_EQ(loop.most.contact_n, 0.0);
  const configuration::RigFile file = Levitator().rig;
  return levitator::Diagnose(file, {levitator::MakeSeries("run", file, rows)}, {}, {}).report;
}

/// Diagnosed from the shipped scenario, then from the plan of that answer.
void ExpectThePlanToSeparate(const std::string& effect, const std::string& other,
                             const std::function<void(configuration::RigFile&)>& hide) {
  ShippedLoop first = Levitator();
  hide(first.rig);
  const diagnosis::DiagnosisReport tied = Ask(first);
  ASSERT_FALSE(tied.ties.empty());
  // Whichever of them is named: nothing in the record decides.
  std::vector<std::string> together = tied.ties.front().others;
  together.push_back(tied.ties.front().cause);
  for (const std::string& one : {effect, other}) {
    ASSERT_NE(std::find(together.begin(), together.end(), one), together.end()) << one;
  }
  ShippedLoop second = Levitator();
  hide(second.rig);
  second.scenario = configuration::ParseScenario(levitator::PlanScenario(Levitator().rig, tied),
                                                 "next.yaml", second.rig.numbers);
  const diagnosis::DiagnosisReport separated = Ask(second);
  ASSERT_EQ(separated.ties.size(), 1U) << separated.verdict_sentence;
  EXPECT_EQ(separated.ties.front().cause, effect);
  EXPECT_TRUE(separated.ties.front().others.empty()) << separated.ties.front().others.front();
}

TEST(LevitatorPlan, TellsALoadFromAnUnevenPairOfCoils) {
  ExpectThePlanToSeparate("static_load", "coil_asymmetry", [](configuration::RigFile& rig) {
    rig.plant.effects = {Entry(effect::Id::kStaticLoad, {0.0, 0.06, 0.0})};
  });
}

TEST(LevitatorPlan, TellsAProfileOfTheInductanceFromItsSize) {
  ExpectThePlanToSeparate("inductance_profile", "coil_inductance", [](configuration::RigFile& rig) {
    rig.plant.bearings[0].amplifier.voltage->decay_m = 9e-3;
    rig.plant.bearings[0].amplifier.voltage->time_constant_s = 20e-3;
  });
}

TEST(LevitatorPlan, KeepsTheBallInTheFieldWithAllThatItCanDo) {
  diagnosis::DiagnosisReport nameless;
  nameless.verdict = diagnosis::Verdict::kUnknown;
  ShippedLoop loop = Levitator();
  loop.scenario = configuration::ParseScenario(levitator::PlanScenario(loop.rig, nameless),
                                               "next.yaml", loop.rig.numbers);
  EXPECT_EQ(loop.Play(3, 60.0), "");
  EXPECT_EQ(loop.most.contact_n, 0.0);
  EXPECT_LT(loop.most.orbit_m, 0.8 * loop.rig.plant.bearings[0].touchdown.clearance_m);
  EXPECT_GT(loop.most.orbit_m, 2e-3) << "led over its stroke";
}

}  // namespace
}  // namespace levitas::test

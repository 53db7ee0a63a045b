// A slew limit between two members of its family is found where it is, and explains what neither
// neighbour does.

#include "diagnosis/inference/refine_shape.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "benchmark/accuracy/trial.hpp"
#include "diagnosis/inference/calibrate.hpp"
#include "diagnosis/records/load.hpp"
#include "diagnosis/terms/terms.hpp"

namespace levitas::diagnosis {
namespace {

double TrueSlew(const accuracy::Trial& trial) {
  for (const auto& entry : trial.ground_truth.truth.config.effects) {
    if (entry.id == effect::Id::kAmplifierSlew) return entry.values[0];
  }
  return 0.0;
}

TEST(RefineShape, FindsTheShapeBetweenTwoMembers) {
  const accuracy::TestRig bench = accuracy::LoadTestRig("flexible_rotor", {"flexible_rotor"});
  const RigView rig(bench.rig.numbers, bench.rig.plant);
  accuracy::TrialPlan plan;
  plan.seed = 31;
  plan.hidden = {effect::Id::kAmplifierSlew};
  // Four times what is clear: a limit half way between two members, which the currents reach often
  // enough that the record holds far more than what decides.
  plan.size = 4.0;
  plan.bits_per_axis = 500;
  plan.runup_s = 1.0;
  const accuracy::Trial trial = accuracy::MakeTrial(bench, plan);
  std::vector<Record> records{trial.records[0]};
  const std::vector<Term> terms = AllTerms(rig, Tolerances{}, LargestOrbit(records, rig.axes));
  const Search search(rig, terms);
  const Gains gains = search.DesignGains(records, kSlow);
  const Refiner refiner(search, terms, records, gains, rig.axes);
  const Refined calibrated =
      CalibrateNuisances(rig, search, terms, records, records, gains, kSlow, 4);
  ASSERT_TRUE(calibrated.ok);
  const View view =
      search.Linearise(records, gains, calibrated.point, kWhiteningOrder, search.Everything());
  const auto member =
      std::find_if(search.hypotheses().begin(), search.hypotheses().end(), [](const Hypothesis& h) {
        return h.effect == effect::Id::kAmplifierSlew && h.place == "4000 A/s";
      });
  ASSERT_NE(member, search.hypotheses().end());
  ASSERT_TRUE(HasFamily(*member, terms));
  const std::vector<Hypothesis> causes{*member};
  const Refined blunt =
      refiner.Fit(causes, {search.Solve(view.problem, causes), view.point.shapes}, view, 5);
  ASSERT_TRUE(blunt.ok);
  const Refined sharp =
      RefineShape(RefinerMemberFits(refiner, causes, view, 5), *member, blunt, terms);
  EXPECT_GT(sharp.evidence, blunt.evidence + kDecisive);
  const double found = sharp.point.shapes[member->terms.front()][0];
  EXPECT_NEAR(found, TrueSlew(trial), 0.05 * TrueSlew(trial));
}

}  // namespace
}  // namespace levitas::diagnosis

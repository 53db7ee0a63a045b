// Adding and dropping causes where a fit fails, is not confirmed, or is not worth its time.

#include <gtest/gtest.h>

#include <tuple>
#include <utility>

#include "diagnosis/inference/selection_steps.hpp"
#include "tests/unit/diagnosis/toy_landscape.hpp"

namespace levitas::diagnosis {
namespace {

using effect::Id;
using Effects = ToyLandscape::Effects;

bool AddThoroughly(ToyLandscape& toy, CauseSelection& found) {
  return AddCause(toy, ThoroughRules(), 0.2, found);
}

// Taken at 40 nat, as the failed fit has it, the effect of -3 nat would lose.
TEST(AddCauseToALostFit, ComparesWithTheLinearisedEvidence) {
  ToyLandscape toy({10.0});
  const Hypothesis h = toy.Add(Id::kUnbalance, {1.0});
  toy.refused.insert(Effects{});
  toy.fitted[Effects{}] = 40.0;
  CauseSelection found = toy.Found({});
  ASSERT_TRUE(AddThoroughly(toy, found));
  EXPECT_EQ(ToyLandscape::EffectsOf(found.causes), Effects{h.effect});
}

// 47 nat on the screen, nothing in its fit: it may need more passes. Its shape does, too.
TEST(AddUnconfirmedCause, FindsItsShapeWhereAFitFollowsAndTheSearchIsThorough) {
  for (const auto& [follows, first_only, place] :
       {std::tuple{true, false, "at its shape"}, std::tuple{false, false, "here"},
        std::tuple{true, true, "here"}}) {
    ToyLandscape toy({10.0});
    const Hypothesis family = toy.Add(Id::kAmplifierSlew, {1.0});
    toy.shape[family.effect] = 20.0;
    toy.fitted[{family.effect}] = -50.0;
    if (!follows) toy.refused.insert({family.effect});
    SelectionRules rules = ThoroughRules();
    rules.effort.first_cause_only = first_only;
    CauseSelection found = toy.Found({});
    ASSERT_TRUE(AddCause(toy, rules, 0.2, found));
    EXPECT_EQ(toy.PlaceAt(found.point, found.causes.front()), place) << follows << first_only;
    EXPECT_NEAR(found.point.theta.front(), 10.0, 1e-9);
  }
}

// The screen errs by a share of the gain: of 197 nat, what has less than 0.3 * 197 = 59.1 is not
// the better one. 12^2 / 2 - 3 = 69, 10^2 / 2 - 3 = 47.
TEST(AddCause, FitsOnlyWhatTheScreenMayHaveMisjudged) {
  for (const auto& [size, fitted] : {std::pair{12.0, true}, std::pair{10.0, false}}) {
    ToyLandscape toy({20.0, size});
    toy.Add(Id::kUnbalance, {1.0, 0.0});
    const Hypothesis second = toy.Add(Id::kShaftBow, {0.0, 1.0});
    CauseSelection found = toy.Found({});
    ASSERT_TRUE(AddThoroughly(toy, found));
    EXPECT_EQ(WasFitted(toy, {second.effect}), fitted) << size;
  }
}

// Less than nothing on the screen, 20 nat in the fit: laws bend away from the screen.
TEST(AddCause, FitsTheBestOfTheScreenWhateverItGivesThemWhereItDoesNotDecide) {
  for (const bool decides : {true, false}) {
    ToyLandscape toy({0.1});
    const Hypothesis h = toy.Add(Id::kUnbalance, {1.0});
    toy.fitted[{h.effect}] = 20.0;
    SelectionRules rules = ThoroughRules();
    rules.screen_decides = decides;
    CauseSelection found = toy.Found({});
    EXPECT_EQ(AddCause(toy, rules, 0.2, found), !decides);
    EXPECT_EQ(ToyLandscape::EffectsOf(found.causes), decides ? Effects{} : Effects{h.effect});
    if (decides) continue;
    ASSERT_EQ(found.refitted.size(), 1U);
    EXPECT_NEAR(found.refitted.front().score, 20.0 - toy.EvidenceOf({}), 1e-9) << "of the fit";
  }
}

// A fit worth 20 nat is there for whoever begins near the mode.
struct Elsewhere {
  Elsewhere() {
    toy.from[0.03] = -30.0;
    toy.probes.push_back({0, 0, 0.03});
  }
  ToyLandscape toy{{10.0, 0.0}};
  Hypothesis mode = toy.Add(Id::kModalFrequency, {0.0, 1.0});
  CauseSelection found = toy.Found({});
};

// 47 nat on the screen are no cause before a fit has confirmed them, and no fit is begun any more.
TEST(AddCause, FitsAndAddsNothingOnceASearchIsToEnd) {
  for (const bool stop : {false, true}) {
    ToyLandscape toy({10.0});
    const Hypothesis h = toy.Add(Id::kUnbalance, {1.0});
    toy.stop = stop;
    CauseSelection found = toy.Found({});
    EXPECT_EQ(AddThoroughly(toy, found), !stop);
    EXPECT_EQ(found.causes.empty(), stop);
    EXPECT_EQ(WasFitted(toy, {h.effect}), !stop);
  }
}

TEST(AddProbedMode, IsNotLookedForInAFirstAnswer) {
  for (const bool first_only : {true, false}) {
    Elsewhere e;
    SelectionRules rules = ThoroughRules();
    rules.effort.first_cause_only = first_only;
    EXPECT_EQ(AddCause(e.toy, rules, 0.2, e.found), !first_only);
  }
}

TEST(AddProbedMode, IsPassedOverWhereNoFitFollows) {
  Elsewhere e;
  e.toy.refused.insert({e.mode.effect});
  EXPECT_FALSE(AddThoroughly(e.toy, e.found));
  EXPECT_TRUE(e.found.causes.empty());
  EXPECT_EQ(e.found.refitted.size(), 1U) << "by the screen";
}

// 20 nat beside a first cause of 100: the screen's 47 are more.
TEST(AddProbedMode, GivesWayToWhatTheScreenFoundBetter) {
  Elsewhere e;
  const Hypothesis better = e.toy.Add(Id::kUnbalance, {1.0, 0.0});
  e.found = e.toy.Found({});
  ASSERT_TRUE(AddThoroughly(e.toy, e.found));
  EXPECT_EQ(ToyLandscape::EffectsOf(e.found.causes), Effects{better.effect});
}

TEST(AddCauseToTwo, DropsTheSuperfluousOneAndKeepsTheOther) {
  ToyLandscape toy({10.0, 0.0, 9.0});
  const Hypothesis imitation = toy.Add(Id::kUnbalance, {1.0, 1.0, 0.0});
  const Hypothesis other = toy.Add(Id::kShaftBow, {0.0, 0.0, 1.0});
  const Hypothesis true_cause = toy.Add(Id::kMisalignment, {1.0, 0.0, 0.0});
  CauseSelection found = toy.Found({imitation, other});
  ASSERT_TRUE(AddThoroughly(toy, found));
  EXPECT_EQ(ToyLandscape::EffectsOf(found.causes), (Effects{other.effect, true_cause.effect}));
  EXPECT_NEAR(found.point.theta[imitation.terms.front()], 0.0, 1e-9);
  EXPECT_NEAR(found.point.theta[other.terms.front()], 9.0, 1e-9);
}

// -1 nat for the second: 2^2 / 2 - 3.
TEST(DropUnprovenOfThree, DropsTheOneInTheMiddleAlone) {
  ToyLandscape toy({10.0, 2.0, 9.0});
  const Hypothesis x = toy.Add(Id::kUnbalance, {1.0, 0.0, 0.0});
  const Hypothesis y = toy.Add(Id::kShaftBow, {0.0, 1.0, 0.0});
  const Hypothesis z = toy.Add(Id::kMisalignment, {0.0, 0.0, 1.0});
  CauseSelection found = toy.Found({x, y, z});
  DropUnproven(toy, ThoroughRules(), found);
  EXPECT_EQ(ToyLandscape::EffectsOf(found.causes), (Effects{x.effect, z.effect}));
  EXPECT_NEAR(found.point.theta[x.terms.front()], 10.0, 1e-9);
  EXPECT_NEAR(found.point.theta[y.terms.front()], 0.0, 1e-9);
}

// Of two that are the same each is worth nothing beside the other: one of them must stay.
TEST(DropUnprovenOfThree, LeavesOneOfTwoThatStandForEachOther) {
  ToyLandscape toy({10.0, 9.0});
  const Hypothesis x = toy.Add(Id::kUnbalance, {1.0, 0.0});
  const Hypothesis twin = toy.Add(Id::kShaftBow, {1.0, 0.0});
  const Hypothesis y = toy.Add(Id::kMisalignment, {0.0, 1.0});
  CauseSelection found = toy.Found({x, y, twin});
  DropUnproven(toy, ThoroughRules(), found);
  ASSERT_EQ(found.causes.size(), 2U);
  EXPECT_TRUE(ToyLandscape::EffectsOf(found.causes).contains(y.effect));
  EXPECT_NEAR(found.point.theta[x.terms.front()] + found.point.theta[twin.terms.front()], 10.0,
              1e-9);
}

// Two causes of 47 nat are named; a third is worth 47 or, of 2 - 3 nat, nothing.
TEST(DoubtCutOffChain, DoubtsAFullChainThatAnotherCauseWouldLengthen) {
  for (const auto& [third, most, doubt] :
       {std::tuple{10.0, 2U, Doubt::kCutOff}, std::tuple{2.0, 2U, Doubt::kNothing},
        std::tuple{10.0, 3U, Doubt::kNothing}}) {
    ToyLandscape toy({10.0, 10.0, third});
    const Hypothesis first = toy.Add(Id::kUnbalance, {1.0, 0.0, 0.0});
    const Hypothesis second = toy.Add(Id::kShaftBow, {0.0, 1.0, 0.0});
    toy.Add(Id::kStaticLoad, {0.0, 0.0, 1.0});
    SelectionRules rules = ThoroughRules();
    rules.most_causes = most;
    CauseSelection found = toy.Found({first, second});
    DoubtCutOffChain(toy, rules, found);
    EXPECT_EQ(found.doubt, doubt) << third << " " << most;
    EXPECT_EQ(found.causes.size(), 2U) << "none is added or dropped";
  }
}

TEST(DoubtCutOffChain, LeavesOneCauseAndAnEarlierDoubt) {
  ToyLandscape toy({10.0, 10.0});
  const Hypothesis first = toy.Add(Id::kUnbalance, {1.0, 0.0});
  toy.Add(Id::kShaftBow, {0.0, 1.0});
  SelectionRules rules = ThoroughRules();
  rules.most_causes = 1;
  CauseSelection found = toy.Found({first});
  DoubtCutOffChain(toy, rules, found);
  EXPECT_EQ(found.doubt, Doubt::kNothing);
  found.causes.push_back(first);
  found.doubt = Doubt::kValidationHarm;
  DoubtCutOffChain(toy, rules, found);
  EXPECT_EQ(found.doubt, Doubt::kValidationHarm);
}

}  // namespace
}  // namespace levitas::diagnosis

// Adding, merging and dropping causes, on evidence that is known.

#include "diagnosis/inference/selection_steps.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <utility>

#include "plant_sim/effect/catalogue.hpp"
#include "tests/unit/diagnosis/toy_landscape.hpp"

namespace levitas::diagnosis {
namespace {

using Effects = std::vector<effect::Id>;

Effects InOrder(const std::vector<Hypothesis>& causes) {
  Effects effects;
  for (const Hypothesis& h : causes) effects.push_back(h.effect);
  return effects;
}

bool AddTo(ToyLandscape& toy, CauseSelection& found) {
  return AddCause(toy, ThoroughRules(), 0.2, found);
}

TEST(AddCause, TakesTheEffectThatExplainsMostAndItsFit) {
  ToyLandscape toy({10.0, 4.0});
  toy.Add(role::kLesser, {0.0, 1.0});
  const Hypothesis greater = toy.Add(role::kGreater, {1.0, 0.0});
  CauseSelection found = toy.Found({});
  ASSERT_TRUE(AddTo(toy, found));
  EXPECT_EQ(InOrder(found.causes), Effects{role::kGreater});
  EXPECT_NEAR(found.point.theta[greater.terms.front()], 10.0, 1e-9);
  ASSERT_FALSE(found.refitted.empty());
  EXPECT_TRUE(found.refitted.front().refitted);
}

TEST(AddCause, LeavesWhatIsNotDecisive) {
  ToyLandscape toy({3.9, 0.0});  // 4.6 nat after its price
  toy.Add(role::kWeak, {1.0, 0.0});
  CauseSelection found = toy.Found({});
  EXPECT_FALSE(AddTo(toy, found));
  EXPECT_TRUE(found.causes.empty());
  EXPECT_TRUE(toy.fits.empty()) << "nothing was worth a fit";
}

// A further cause may only be what the law of the first one is not exact in.
TEST(AddCause, AsksMoreOfAFurtherCauseWhereMuchIsExplainedAlready) {
  for (const auto& [size, added] : {std::pair{10.0, true}, std::pair{100.0, false}}) {
    ToyLandscape toy({size, 5.0});  // 9.5 nat for the second
    const Hypothesis first = toy.Add(role::kFirst, {1.0, 0.0});
    toy.Add(role::kSecond, {0.0, 1.0});
    CauseSelection found = toy.Found({first});
    EXPECT_EQ(AddTo(toy, found), added) << size;
    EXPECT_EQ(found.causes.size(), added ? 2U : 1U);
  }
}

// A hum is a sine of a known frequency: what is found beside a loud one is no error of its law.
TEST(AddCause, AsksNoMoreBesideALoudHum) {
  for (const auto& [effect, added] :
       {std::pair{effect::Id::kMainsPickup, true}, std::pair{role::kFirst, false}}) {
    ToyLandscape toy({100.0, 5.0});
    const Hypothesis first = toy.Add(effect, {1.0, 0.0});
    toy.Add(role::kSecond, {0.0, 1.0});
    CauseSelection found = toy.Found({first});
    EXPECT_EQ(AddTo(toy, found), added) << effect::At(effect).name;
  }
}

TEST(AddCause, IsDecidedByTheNonlinearModel) {
  ToyLandscape toy({10.0, 9.8});
  toy.Add(role::kBetterOnTheScreen, {1.0, 0.0});
  toy.Add(role::kBetterInFact, {0.0, 1.0});
  toy.fitted[{role::kBetterOnTheScreen}] = -80.0;
  CauseSelection found = toy.Found({});
  ASSERT_TRUE(AddTo(toy, found));
  EXPECT_EQ(InOrder(found.causes), Effects{role::kBetterInFact});
}

// 12 nat that no fit confirms are none; 47 are linearised anew, for a large step takes passes.
TEST(AddCause, TakesWithoutConfirmationOnlyWhatIsFarBeyondDoubt) {
  for (const auto& [size, added] : {std::pair{5.5, false}, std::pair{10.0, true}}) {
    ToyLandscape toy({size});
    toy.Add(role::kEffect, {1.0});
    toy.refused.insert({role::kEffect});
    CauseSelection found = toy.Found({});
    EXPECT_EQ(AddTo(toy, found), added) << size;
    EXPECT_EQ(found.causes.size(), added ? 1U : 0U);
  }
}

TEST(AddCause, DropsAnEarlierOneThatItMakesSuperfluous) {
  ToyLandscape toy({10.0, 0.0});
  const Hypothesis imitation = toy.Add(role::kImitation, {1.0, 1.0});
  toy.Add(role::kTrueCause, {1.0, 0.0});
  CauseSelection found = toy.Found({imitation});
  ASSERT_TRUE(AddTo(toy, found));
  EXPECT_EQ(InOrder(found.causes), Effects{role::kTrueCause});
  EXPECT_NEAR(found.point.theta[1], 10.0, 1e-9);
  EXPECT_NEAR(found.point.theta[0], 0.0, 1e-9);
}

TEST(AddCause, LooksWhereTheScreenSeesNothing) {
  ToyLandscape toy({10.0, 0.0});
  toy.Add(role::kMode, {0.0, 1.0});  // the derivative about the file's frequency says nothing
  toy.from[0.03] = -1.0;             // but a fit that begins near the mode reaches it
  CauseSelection found = toy.Found({});
  EXPECT_FALSE(AddTo(toy, found));
  toy.probes.push_back({0, 0, 0.02});
  EXPECT_FALSE(AddTo(toy, found));
  toy.probes.push_back({0, 0, 0.03});
  ASSERT_TRUE(AddTo(toy, found));
  EXPECT_EQ(InOrder(found.causes), Effects{role::kMode});
}

TEST(AddCause, FindsTheShapeOfAFamilyUnlessAFirstAnswerIsAsked) {
  for (const bool first_only : {false, true}) {
    ToyLandscape toy({10.0});
    toy.Add(role::kFamily, {1.0});
    toy.shape[role::kFamily] = 20.0;
    SelectionRules rules = ThoroughRules();
    rules.effort.first_cause_only = first_only;
    CauseSelection found = toy.Found({});
    ASSERT_TRUE(AddCause(toy, rules, 0.2, found));
    EXPECT_EQ(toy.PlaceAt(found.point, found.causes.front()), first_only ? "here" : "at its shape");
  }
}

TEST(AddCause, WithoutHypothesesAddsNone) {
  ToyLandscape toy({10.0});
  CauseSelection found = toy.Found({});
  EXPECT_FALSE(AddTo(toy, found));
}

TEST(MergeCauses, PutsOneEffectInThePlaceOfTwoThatImitateIt) {
  ToyLandscape toy({10.0, 10.0});
  const Hypothesis x = toy.Add(role::kX, {1.0, 0.0});
  const Hypothesis y = toy.Add(role::kY, {0.0, 1.0});
  toy.Add(role::kBoth, {1.0, 1.0});
  CauseSelection found = toy.Found({x, y});
  MergeCauses(toy, ThoroughRules(), found);
  EXPECT_EQ(InOrder(found.causes), Effects{role::kBoth});
  EXPECT_NEAR(found.point.theta[2], 10.0 * std::sqrt(2.0), 1e-9);
  EXPECT_EQ(toy.linearised.size(), 1U) << "at the new causes";
}

TEST(MergeCauses, LeavesTwoThatNoSingleEffectExplains) {
  ToyLandscape toy({10.0, -6.0});
  const Hypothesis x = toy.Add(role::kX, {1.0, 0.0});
  const Hypothesis y = toy.Add(role::kY, {0.0, 1.0});
  toy.Add(role::kBoth, {1.0, 1.0});
  CauseSelection found = toy.Found({x, y});
  MergeCauses(toy, ThoroughRules(), found);
  EXPECT_EQ(InOrder(found.causes), (Effects{role::kX, role::kY}));
  EXPECT_EQ(toy.linearised.size(), 0U);
}

// Beside a loud hum, a share of what the hum explains is no reason to give up the other cause.
TEST(MergeCauses, DropsNothingForTheShareOfALoudHum) {
  for (const auto& [effect, left] :
       {std::pair{effect::Id::kMainsPickup, 2U}, std::pair{role::kFirst, 1U}}) {
    ToyLandscape toy({100.0, 8.0});
    const Hypothesis first = toy.Add(effect, {1.0, 0.0});
    const Hypothesis second = toy.Add(role::kSecond, {0.0, 1.0});
    CauseSelection found = toy.Found({first, second});
    MergeCauses(toy, ThoroughRules(), found);
    EXPECT_EQ(found.causes.size(), left) << effect::At(effect).name;
  }
}

TEST(MergeCauses, FitsNoSetTwice) {
  ToyLandscape toy({10.0, -8.0, 9.0, 0.0});
  const Hypothesis x = toy.Add(role::kX, {1.0, 0.0, 0.0, 0.0});
  const Hypothesis y = toy.Add(role::kY, {0.0, 1.0, 0.0, 0.0});
  const Hypothesis z = toy.Add(role::kZ, {0.0, 0.0, 1.0, 0.0});
  toy.Add(role::kElsewhere, {0.0, 0.0, 0.0, 1.0});
  CauseSelection found = toy.Found({x, y, z});
  MergeCauses(toy, ThoroughRules(), found);
  EXPECT_EQ(found.causes.size(), 3U);
  const std::set<ToyLandscape::Effects> different(toy.fits.begin(), toy.fits.end());
  EXPECT_GT(different.size(), 6U) << "pairs were tried";
  EXPECT_EQ(different.size(), toy.fits.size());
}

TEST(MergeCauses, PutsOneInThePlaceOfThree) {
  ToyLandscape toy({10.0, 10.0, 10.0});
  const Hypothesis x = toy.Add(role::kX, {1.0, 0.0, 0.0});
  const Hypothesis y = toy.Add(role::kY, {0.0, 1.0, 0.0});
  const Hypothesis z = toy.Add(role::kZ, {0.0, 0.0, 1.0});
  toy.Add(role::kAll, {1.0, 1.0, 1.0});
  CauseSelection found = toy.Found({x, y, z});
  MergeCauses(toy, ThoroughRules(), found);
  EXPECT_EQ(InOrder(found.causes), Effects{role::kAll});
  EXPECT_EQ(toy.linearised.size(), 1U) << "at once, not two after two";
}

TEST(MergeCauses, PutsOneInThePlaceOfTwoBesideAThirdThatStays) {
  ToyLandscape toy({10.0, 10.0, 0.0, 9.0});
  const Hypothesis x = toy.Add(role::kX, {1.0, 0.0, 0.0, 0.0});
  const Hypothesis other = toy.Add(role::kOther, {0.0, 0.0, 0.0, 1.0});
  const Hypothesis y = toy.Add(role::kY, {0.0, 1.0, 0.0, 0.0});
  toy.Add(role::kBoth, {1.0, 1.0, 0.0, 0.0});
  CauseSelection found = toy.Found({x, other, y});
  MergeCauses(toy, ThoroughRules(), found);
  EXPECT_EQ(ToyLandscape::EffectsOf(found.causes),
            (ToyLandscape::Effects{role::kBoth, role::kOther}));
}

TEST(MergeCauses, LeavesCausesThatCannotBeFittedAnyMore) {
  ToyLandscape toy({10.0, 10.0});
  const Hypothesis x = toy.Add(role::kX, {1.0, 0.0});
  const Hypothesis y = toy.Add(role::kY, {0.0, 1.0});
  toy.Add(role::kBoth, {1.0, 1.0});
  toy.refused.insert({role::kX, role::kY});
  CauseSelection found = toy.Found({x, y});
  MergeCauses(toy, ThoroughRules(), found);
  EXPECT_EQ(found.causes.size(), 2U);
}

TEST(DropUnproven, DropsTheWeakestFirstAndAsksTheOthersAgain) {
  // Beside `x` the imitation explains nothing; without it, it would have been decisive.
  ToyLandscape toy({10.0, 0.0});
  const Hypothesis imitation = toy.Add(role::kImitation, {1.0, 1.0});
  const Hypothesis x = toy.Add(role::kX, {1.0, 0.0});
  CauseSelection found = toy.Found({imitation, x});
  DropUnproven(toy, ThoroughRules(), found);
  EXPECT_EQ(InOrder(found.causes), Effects{role::kX});
  EXPECT_NEAR(found.point.theta[1], 10.0, 1e-9);
}

TEST(DropUnproven, KeepsDecisiveOnes) {
  ToyLandscape toy({10.0, 9.0});
  const Hypothesis x = toy.Add(role::kX, {1.0, 0.0});
  const Hypothesis y = toy.Add(role::kY, {0.0, 1.0});
  CauseSelection found = toy.Found({x, y});
  DropUnproven(toy, ThoroughRules(), found);
  EXPECT_EQ(found.causes.size(), 2U);
}

TEST(DropUnproven, EndsAtTheCalibratedModel) {
  ToyLandscape toy({2.0, 1.0});
  const Hypothesis x = toy.Add(role::kX, {1.0, 0.0});
  const Hypothesis y = toy.Add(role::kY, {0.0, 1.0});
  CauseSelection found = toy.Found({x, y});
  found.calibrated.theta = {0.25, -0.5};
  DropUnproven(toy, ThoroughRules(), found);
  EXPECT_TRUE(found.causes.empty());
  EXPECT_EQ(found.point, found.calibrated);
}

}  // namespace
}  // namespace levitas::diagnosis

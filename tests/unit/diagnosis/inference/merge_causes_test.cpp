// Merging of two and of three causes: what counts is the nonlinear fit, and how far it may fall.

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "diagnosis/inference/selection_steps.hpp"
#include "tests/unit/diagnosis/toy_landscape.hpp"

namespace levitas::diagnosis {
namespace {

using effect::Id;
using Effects = ToyLandscape::Effects;

/// Two causes that together leave nothing of the readings: -6 nat. They explain 94 nat, so that one
/// effect in their place may cost 5 + 0.02 * 94 = 6.88 nat: -12.88.
struct TwoToMerge {
  ToyLandscape toy{{10.0, 10.0}};
  Hypothesis x = toy.Add(Id::kUnbalance, {1.0, 0.0});
  Hypothesis y = toy.Add(Id::kShaftBow, {0.0, 1.0});
  /// -3 nat on the screen
  Hypothesis both = toy.Add(Id::kMisalignment, {1.0, 1.0});

  [[nodiscard]] CauseSelection Merged(const SelectionRules& rules = ThoroughRules()) {
    CauseSelection found = toy.Found({x, y});
    MergeCauses(toy, rules, found);
    return found;
  }
};

TEST(MergeTwoCauses, MayCostTheLeastGainOfACauseAndNoMore) {
  for (const auto& [evidence, left] : {std::pair{-12.8, 1U}, std::pair{-13.0, 2U}}) {
    TwoToMerge two;
    two.toy.fitted[{two.both.effect}] = evidence;
    EXPECT_EQ(two.Merged().causes.size(), left) << evidence;
  }
}

TEST(MergeTwoCauses, LeavesThemOnceASearchIsToEnd) {
  TwoToMerge two;
  two.toy.fitted[{two.both.effect}] = 0.0;
  two.toy.stop = true;
  EXPECT_EQ(two.Merged().causes.size(), 2U);
  EXPECT_TRUE(two.toy.fits.empty());
}

TEST(MergeTwoCauses, TakesTheEffectThatTheNonlinearModelPrefers) {
  TwoToMerge two;
  // Leaves 11.8 of 200: -8.9 nat, on the screen and in fact.
  const Hypothesis skew = two.toy.Add(Id::kSensorRunout, {1.0, 0.6});
  two.toy.fitted[{two.both.effect}] = -20.0;
  const CauseSelection found = two.Merged();
  EXPECT_EQ(ToyLandscape::EffectsOf(found.causes), Effects{skew.effect});
  EXPECT_NEAR(found.point.theta[skew.terms.front()], 16.0 / std::sqrt(1.36), 1e-9);
  EXPECT_NEAR(found.point.theta[two.both.terms.front()], 0.0, 1e-9);
}

TEST(MergeTwoCauses, PassesOverAnEffectThatCannotBeFitted) {
  TwoToMerge two;
  const Hypothesis skew = two.toy.Add(Id::kSensorRunout, {1.0, 0.6});
  two.toy.refused.insert({two.both.effect});
  EXPECT_EQ(ToyLandscape::EffectsOf(two.Merged().causes), Effects{skew.effect});
  two.toy.refused.insert({skew.effect});
  EXPECT_EQ(ToyLandscape::EffectsOf(two.Merged().causes), (Effects{two.x.effect, two.y.effect}));
}

TEST(MergeTwoCauses, TriesNoMoreThanTheShortlist) {
  TwoToMerge two;
  const Hypothesis skew = two.toy.Add(Id::kSensorRunout, {1.0, 0.6});
  two.toy.fitted[{two.both.effect}] = -20.0;
  SelectionRules rules = ThoroughRules();
  rules.effort.shortlist = 1;
  EXPECT_EQ(two.Merged(rules).causes.size(), 2U);
  EXPECT_FALSE(WasFitted(two.toy, {skew.effect}));
}

TEST(MergeTwoCauses, OfOneEffectGivesThatEffectAtAThirdPlace) {
  ToyLandscape toy({10.0, 10.0});
  const Hypothesis de = toy.Add(Id::kUnbalance, {1.0, 0.0}, "de");
  const Hypothesis nde = toy.Add(Id::kUnbalance, {0.0, 1.0}, "nde");
  toy.Add(Id::kUnbalance, {1.0, 1.0}, "disc");
  CauseSelection found = toy.Found({de, nde});
  MergeCauses(toy, ThoroughRules(), found);
  ASSERT_EQ(found.causes.size(), 1U);
  EXPECT_EQ(found.causes.front().place, "disc");
}

TEST(MergeTwoCauses, LeavesASingleCauseUnfitted) {
  TwoToMerge two;
  CauseSelection found = two.toy.Found({two.x});
  MergeCauses(two.toy, ThoroughRules(), found);
  EXPECT_EQ(ToyLandscape::EffectsOf(found.causes), Effects{two.x.effect});
  EXPECT_TRUE(two.toy.fits.empty());
}

/// Three causes that leave nothing: -9 nat, 141 explained. Others in their place may cost
/// 5 + 0.02 * 141 = 7.82 nat: -16.82.
struct ThreeToMerge {
  ToyLandscape toy{{10.0, 10.0, 10.0}};
  Hypothesis x = toy.Add(Id::kUnbalance, {1.0, 0.0, 0.0});
  Hypothesis y = toy.Add(Id::kShaftBow, {0.0, 1.0, 0.0});
  Hypothesis z = toy.Add(Id::kMisalignment, {0.0, 0.0, 1.0});
  Hypothesis xy = toy.Add(Id::kSensorRunout, {1.0, 1.0, 0.0});
  /// Of all three readings; beside a cause of its own no fit of it follows.
  Hypothesis all = toy.Add(Id::kBreathingCrack, {1.0, 1.0, 1.0});

  ThreeToMerge() {
    for (const Hypothesis& own : {x, y, z}) toy.refused.insert({all.effect, own.effect});
  }
  [[nodiscard]] Effects Merged(const SelectionRules& rules = ThoroughRules()) {
    CauseSelection found = toy.Found({x, y, z});
    MergeCauses(toy, rules, found);
    theta = found.point.theta;
    return ToyLandscape::EffectsOf(found.causes);
  }
  std::vector<double> theta;
};

// -10 nat for one, -6 for two: one that is worth it is enough.
TEST(MergeThreeCauses, PrefersOneThatExplainsAllToTwoThatExplainMore) {
  ThreeToMerge three;
  three.toy.fitted[{three.all.effect}] = -10.0;
  EXPECT_EQ(three.Merged(), Effects{three.all.effect});
  EXPECT_FALSE(WasFitted(three.toy, {three.xy.effect, three.z.effect}));
}

TEST(MergeThreeCauses, PutsOneInThePlaceOfTwoWhereNoneExplainsAll) {
  ThreeToMerge three;
  three.toy.fitted[{three.all.effect}] = -20.0;
  EXPECT_EQ(three.Merged(), (Effects{three.xy.effect, three.z.effect}));
  EXPECT_NEAR(three.theta[three.xy.terms.front()], 10.0 * std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(three.theta[three.z.terms.front()], 10.0, 1e-9);
  EXPECT_NEAR(three.theta[three.x.terms.front()], 0.0, 1e-9);
}

TEST(MergeThreeCauses, LeavesThemWhereEverythingElseCostsTooMuch) {
  ThreeToMerge three;
  three.toy.fitted = {{{three.all.effect}, -17.0}, {{three.xy.effect, three.z.effect}, -16.9}};
  EXPECT_EQ(three.Merged(), (Effects{three.x.effect, three.y.effect, three.z.effect}));
  EXPECT_TRUE(three.toy.linearised.empty());
}

// Two of -15 nat may be replaced for 5 + 0.02 * 135 = 7.7 nat, by one of -20 then.
TEST(MergeThreeCauses, MergesAgainWhatAMergeLeftAsOftenAsThereMayBeCauses) {
  for (const std::size_t most : {1U, 3U}) {
    ThreeToMerge three;
    three.toy.fitted = {{{three.all.effect}, -20.0}, {{three.xy.effect, three.z.effect}, -15.0}};
    SelectionRules rules = ThoroughRules();
    rules.most_causes = most;
    const Effects expected =
        most == 1 ? Effects{three.xy.effect, three.z.effect} : Effects{three.all.effect};
    EXPECT_EQ(three.Merged(rules), expected) << most;
    EXPECT_EQ(three.toy.linearised.size(), most == 1 ? 1U : 2U);
  }
}

}  // namespace
}  // namespace levitas::diagnosis

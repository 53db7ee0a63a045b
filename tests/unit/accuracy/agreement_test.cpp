// What counts as the same: a diagnosis's answer and what was foretold of it.

#include "benchmark/accuracy/agreement.hpp"

#include <gtest/gtest.h>

namespace levitas::accuracy {
namespace {

using diagnosis::Isolation;
using diagnosis::Prediction;
using Effects = std::vector<effect::Id>;

constexpr effect::Id kA = effect::Id::kUnbalance;
constexpr effect::Id kB = effect::Id::kShaftBow;
constexpr effect::Id kC = effect::Id::kRotorMass;

TEST(Agreement, UnknownAndNoneNameNothingWhateverStandsInTheList) {
  EXPECT_EQ(NamedOrTied("unknown", {effect::Id::kUnbalance}, {}), Effects{});
  EXPECT_EQ(NamedOrTied("none", {}, {effect::Id::kUnbalance}), Effects{});
  EXPECT_EQ(NamedOrTied("suspected", {effect::Id::kUnbalance, effect::Id::kRotorMass},
                        {effect::Id::kShaftBow}),
            (Effects{effect::Id::kUnbalance, effect::Id::kShaftBow}));
}

TEST(Agreement, TheKindFollowsFromWhereTheHiddenEffectStands) {
  EXPECT_EQ(KindOf(kA, {}), Isolation::kNotVisible);
  EXPECT_EQ(KindOf(kA, {kA}), Isolation::kFound);
  EXPECT_EQ(KindOf(kA, {kB, kA}), Isolation::kTied);
  EXPECT_EQ(KindOf(kA, {kB}), Isolation::kTakenFor);
}

TEST(Agreement, EveryEntryOfTheRowCountsOnce) {
  Prediction p;
  p.effect = kA;
  p.isolation = Isolation::kTied;
  p.ties = {kB};
  p.alternatives = {{kB, "", 0.0, 0.0}, {kC, "", 0.0, 0.0}};
  EXPECT_EQ(CompareRow(p, {kA, kB}).right, 3U);
  EXPECT_EQ(CompareRow(p, {kA}).right, 2U) << "b was not named";
  EXPECT_EQ(CompareRow(p, {kC}).right, 0U);
  EXPECT_EQ(CompareRow(p, {kC}).all, 3U);
}

TEST(Agreement, WhatIsTakenForAnotherForetellsTheOtherAlone) {
  Prediction p;
  p.effect = kA;
  p.isolation = Isolation::kTakenFor;
  p.ties = {kB};
  EXPECT_EQ(Foretold(p), Effects{kB});
}

}  // namespace
}  // namespace levitas::accuracy

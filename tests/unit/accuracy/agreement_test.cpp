// What counts as the same: a diagnosis's answer and what was foretold of it.

#include "benchmark/accuracy/agreement.hpp"

#include <gtest/gtest.h>

namespace levitas::accuracy {
namespace {

using diagnosis::Isolation;
using diagnosis::Prediction;
using Names = std::vector<std::string>;

TEST(Agreement, UnknownAndNoneNameNothingWhateverStandsInTheList) {
  EXPECT_EQ(NamedOrTied("unknown", {"unbalance"}, {}), Names{});
  EXPECT_EQ(NamedOrTied("none", {}, {"unbalance"}), Names{});
  EXPECT_EQ(NamedOrTied("suspected", {"unbalance", "rotor_mass"}, {"shaft_bow"}),
            (Names{"unbalance", "shaft_bow"}));
}

TEST(Agreement, TheKindFollowsFromWhereTheHiddenEffectStands) {
  EXPECT_EQ(KindOf("a", {}), Isolation::kNotVisible);
  EXPECT_EQ(KindOf("a", {"a"}), Isolation::kFound);
  EXPECT_EQ(KindOf("a", {"b", "a"}), Isolation::kTied);
  EXPECT_EQ(KindOf("a", {"b"}), Isolation::kTakenFor);
}

TEST(Agreement, EveryEntryOfTheRowCountsOnce) {
  Prediction p;
  p.effect = "a";
  p.isolation = Isolation::kTied;
  p.ties = {"b"};
  p.alternatives = {{"b", "", 0.0, 0.0}, {"c", "", 0.0, 0.0}};
  EXPECT_EQ(CompareRow(p, {"a", "b"}).right, 3U);
  EXPECT_EQ(CompareRow(p, {"a"}).right, 2U) << "b was not named";
  EXPECT_EQ(CompareRow(p, {"c"}).right, 0U);
  EXPECT_EQ(CompareRow(p, {"c"}).all, 3U);
}

TEST(Agreement, WhatIsTakenForAnotherForetellsTheOtherAlone) {
  Prediction p;
  p.effect = "a";
  p.isolation = Isolation::kTakenFor;
  p.ties = {"b"};
  EXPECT_EQ(Foretold(p), Names{"b"});
}

}  // namespace
}  // namespace levitas::accuracy

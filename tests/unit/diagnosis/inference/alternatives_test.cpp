// Ranking every effect in place of the first cause, on evidence that is known.

#include "diagnosis/inference/alternatives.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "tests/unit/diagnosis/toy_landscape.hpp"

namespace levitas::diagnosis {
namespace {

const Candidate& CandidateOf(const CauseSelection& found, effect::Id effect) {
  return *std::find_if(found.candidates.begin(), found.candidates.end(),
                       [effect](const Candidate& c) { return c.effect == effect; });
}

TEST(RankCandidates, PutsTheStrongestCauseFirst) {
  ToyLandscape toy({5.0, 10.0, 7.0});
  const Hypothesis weak = toy.Add(role::kWeak, {1.0, 0.0, 0.0});
  const Hypothesis strong = toy.Add(role::kStrong, {0.0, 1.0, 0.0});
  toy.Add(role::kOther, {0.0, 0.0, 1.0});
  CauseSelection found = toy.Found({strong, weak});
  RankCandidates(toy, ThoroughRules(), found);
  EXPECT_EQ(found.causes.front().effect, role::kStrong) << "as it was";
  found = toy.Found({weak, strong});
  RankCandidates(toy, ThoroughRules(), found);
  EXPECT_EQ(found.causes.front().effect, role::kStrong);
  ASSERT_EQ(found.candidates.size(), 3U);
  EXPECT_EQ(found.candidates.front().effect, role::kStrong);
  EXPECT_NEAR(found.candidates.front().score, 47.0, 1e-9) << "given the weak one";
  EXPECT_EQ(found.candidates[1].effect, role::kOther);
}

// Forward selection chose a place; the ranking must not speak of another one.
TEST(RankCandidates, RanksTheLeaderAtThePlaceThatWasChosen) {
  ToyLandscape toy({10.0, 3.0});
  toy.Add(role::kEffect, {1.0, 0.3}, "better place");
  const Hypothesis chosen = toy.Add(role::kEffect, {1.0, 0.0}, "chosen place");
  CauseSelection found = toy.Found({chosen});
  RankCandidates(toy, ThoroughRules(), found);
  EXPECT_EQ(found.candidates.front().place, "chosen place");
  EXPECT_EQ(found.candidates.front().hypothesis, 1U);
  EXPECT_NEAR(found.candidates.front().score, 47.0, 1e-9);
}

TEST(RankCandidates, OfAFirstAnswerTakesTheScoresOfTheFits) {
  ToyLandscape toy({10.0, 9.9});
  toy.Add(role::kX, {1.0, 0.0});
  toy.Add(role::kY, {0.0, 1.0});
  CauseSelection found = toy.Found({});
  found.refitted = {{role::kX, "here", 1.0, 0, true}};
  RankCandidates(toy, ThoroughRules(), found);
  EXPECT_EQ(found.candidates.front().effect, role::kY);
  EXPECT_EQ(CandidateOf(found, role::kX).score, 1.0);
  EXPECT_TRUE(CandidateOf(found, role::kX).refitted);
}

/// A leader, and an alternative that the linearisation puts a little behind it.
struct Near {
  ToyLandscape toy{{10.0, 3.0}};
  Hypothesis leader = toy.Add(role::kLeader, {1.0, 0.3});
  Hypothesis alternative = toy.Add(role::kAlternative, {1.0, 0.1});
  CauseSelection found = toy.Found({leader});

  void Refit() {
    RankCandidates(toy, ThoroughRules(), found);
    RefitAlternatives(toy, ThoroughRules(), found);
  }
};

TEST(RefitAlternatives, KeepsTheLeaderThatTheNonlinearModelConfirms) {
  Near n;
  n.Refit();
  EXPECT_EQ(n.found.causes.front().effect, role::kLeader);
  EXPECT_TRUE(CandidateOf(n.found, role::kAlternative).refitted);
  EXPECT_NEAR(n.found.leader_evidence, n.toy.EvidenceOf({n.leader}), 1e-9);
}

TEST(RefitAlternatives, PutsABetterOneFirstAndKeepsTheOldLeaderAsContender) {
  Near n;
  n.toy.fitted[{role::kAlternative}] = n.toy.EvidenceOf({n.leader}) + 2.0;
  n.Refit();
  EXPECT_EQ(n.found.causes.front().effect, role::kAlternative);
  EXPECT_EQ(n.found.candidates.front().effect, role::kAlternative);
  EXPECT_NEAR(n.found.leader_evidence, n.toy.EvidenceOf({n.leader}) + 2.0, 1e-9);
  ASSERT_EQ(n.found.contenders.size(), 1U) << "2 nat do not refute it";
  EXPECT_EQ(n.found.contenders.front().causes.front().effect, role::kLeader);
}

TEST(RefitAlternatives, DropsAContenderThatIsRefuted) {
  Near n;
  n.toy.fitted[{role::kAlternative}] = n.toy.EvidenceOf({n.leader}) + 20.0;
  n.Refit();
  EXPECT_TRUE(n.found.contenders.empty());
}

TEST(RefitAlternatives, FitsNoMoreThanItMay) {
  Near n;
  const auto* more = role::kOneMore.begin();
  for (const double share : {0.12, 0.14, 0.16, 0.18, 0.2, 0.22}) {
    n.toy.Add(*more++, {1.0, share});
  }
  n.found = n.toy.Found({n.leader});
  SelectionRules rules = ThoroughRules();
  rules.effort.alternatives = 3;
  RankCandidates(n.toy, rules, n.found);
  n.toy.fits.clear();
  RefitAlternatives(n.toy, rules, n.found);
  EXPECT_EQ(n.toy.fits.size(), 1U + 3U) << "the leader and three";
}

TEST(RefitAlternatives, OfALeaderThatCannotBeFittedChangesNothing) {
  Near n;
  n.toy.refused.insert({role::kLeader});
  n.Refit();
  EXPECT_EQ(n.found.causes.front().effect, role::kLeader);
  EXPECT_EQ(n.found.leader_evidence, std::numeric_limits<double>::infinity());
  EXPECT_FALSE(DropFailedLeader(n.toy, ThoroughRules(), n.found));
}

// The screen gave the leader 47 nat beside the other; refitted, the other explains all but 2 nat.
TEST(DropFailedLeader, DropsOneThatTheOthersDoNotNeed) {
  ToyLandscape toy({10.0, 8.0});
  const Hypothesis leader = toy.Add(role::kLeader, {1.0, 0.0});
  const Hypothesis other = toy.Add(role::kOther, {0.0, 1.0});
  CauseSelection found = toy.Found({leader, other});
  found.leader_evidence = toy.EvidenceOf({leader, other});
  toy.fitted[{role::kOther}] = found.leader_evidence - 2.0;
  EXPECT_TRUE(DropFailedLeader(toy, ThoroughRules(), found));
  ASSERT_EQ(found.causes.size(), 1U);
  EXPECT_EQ(found.causes.front().effect, role::kOther);
  EXPECT_EQ(toy.linearised.size(), 1U);
}

TEST(DropFailedLeader, KeepsOneThatIsDecisive) {
  ToyLandscape toy({10.0, 8.0});
  const Hypothesis leader = toy.Add(role::kLeader, {1.0, 0.0});
  const Hypothesis other = toy.Add(role::kOther, {0.0, 1.0});
  CauseSelection found = toy.Found({leader, other});
  found.leader_evidence = toy.EvidenceOf({leader, other});
  EXPECT_FALSE(DropFailedLeader(toy, ThoroughRules(), found));
  EXPECT_EQ(found.causes.size(), 2U);
  EXPECT_EQ(toy.linearised.size(), 0U);
}

TEST(DropFailedLeader, LeavesTheCalibratedModelWhereTheOnlyCauseFails) {
  ToyLandscape toy({3.0});
  const Hypothesis only = toy.Add(role::kOnly, {1.0});
  CauseSelection found = toy.Found({only});
  found.leader_evidence = toy.EvidenceOf({only});
  found.calibrated.theta = {0.25};
  EXPECT_TRUE(DropFailedLeader(toy, ThoroughRules(), found));
  EXPECT_TRUE(found.causes.empty());
  EXPECT_EQ(toy.starts.back(), found.calibrated.theta);
}

TEST(DropFailedLeader, WithoutCausesHasNone) {
  ToyLandscape toy({3.0});
  CauseSelection found = toy.Found({});
  EXPECT_FALSE(DropFailedLeader(toy, ThoroughRules(), found));
}

}  // namespace
}  // namespace levitas::diagnosis

// Alternatives of the first of several causes, of a strong one, and those whose fit fails.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "diagnosis/inference/alternatives.hpp"
#include "tests/unit/diagnosis/toy_landscape.hpp"

namespace levitas::diagnosis {
namespace {

using effect::Id;
using Effects = ToyLandscape::Effects;

const Candidate& RankedAs(const CauseSelection& found, const Hypothesis& of) {
  return *std::find_if(found.candidates.begin(), found.candidates.end(),
                       [&of](const Candidate& c) { return c.effect == of.effect; });
}

/// A direction of which a reading of the first kind explains that share of its square.
std::vector<double> Explaining(double share) { return {std::sqrt(share), std::sqrt(1.0 - share)}; }

TEST(RankCandidatesOfThree, PutsTheStrongestFirstAndRanksBesideTheOtherTwo) {
  ToyLandscape toy({6.0, 10.0, 8.0});
  const Hypothesis x = toy.Add(Id::kUnbalance, {1.0, 0.0, 0.0});
  const Hypothesis y = toy.Add(Id::kShaftBow, {0.0, 1.0, 0.0});
  const Hypothesis z = toy.Add(Id::kMisalignment, {0.0, 0.0, 1.0});
  CauseSelection found = toy.Found({x, z, y});
  RankCandidates(toy, ThoroughRules(), found);
  EXPECT_EQ(found.causes.front().effect, y.effect);
  EXPECT_NEAR(RankedAs(found, y).score, 47.0, 1e-9);
  EXPECT_NEAR(RankedAs(found, x).score, -3.0, 1e-9) << "explained already";
  EXPECT_NEAR(RankedAs(found, z).score, -3.0, 1e-9) << "explained already";
}

// 47 nat on the linearisation, 11 by the fit that took it.
TEST(RankCandidatesOfAFirstAnswer, TakesTheLeadersFitUnlessItWasWhitenedAnew) {
  for (const auto& [anew, score] : {std::pair{false, 11.0}, std::pair{true, 47.0}}) {
    ToyLandscape toy({10.0});
    const Hypothesis x = toy.Add(Id::kUnbalance, {1.0});
    SelectionRules rules = ThoroughRules();
    rules.effort.first_cause_only = true;
    CauseSelection found = toy.Found({x});
    found.refitted = {Candidate{x.effect, x.place, 11.0, 0, true}};
    found.whitened_anew = anew;
    RankCandidates(toy, rules, found);
    EXPECT_NEAR(found.candidates.front().score, score, 1e-9);
  }
}

/// A leader that explains all of one reading, and an alternative that explains `share` of it.
struct LeaderBeside {
  LeaderBeside(double reading, double share)
      : toy({reading, 0.0}), alternative(toy.Add(Id::kMisalignment, Explaining(share))) {
    leader = toy.Add(Id::kUnbalance, {1.0, 0.0});
    found = toy.Found({leader});
  }
  void Refit() {
    RankCandidates(toy, ThoroughRules(), found);
    RefitAlternatives(toy, ThoroughRules(), found);
  }
  ToyLandscape toy;
  Hypothesis leader, alternative;
  CauseSelection found;
};

// 47 nat for the leader: 30 less are near. 50 s - 3 = 22 and 14.5.
TEST(RefitAlternatives, FitsWhatComesWithinTwiceNearNat) {
  for (const auto& [share, tried] : {std::pair{0.5, true}, std::pair{0.35, false}}) {
    LeaderBeside of(10.0, share);
    of.Refit();
    EXPECT_EQ(WasFitted(of.toy, {of.alternative.effect}), tried) << share;
    EXPECT_EQ(RankedAs(of.found, of.alternative).refitted, tried);
  }
}

// 4997 nat: 0.02 of it are 99.9, more than 30. 5000 s - 3 = 4922 and 4847.
TEST(RefitAlternatives, OfAStrongLeaderFitsWhatComesWithinAShareOfIt) {
  for (const auto& [share, tried] : {std::pair{0.985, true}, std::pair{0.97, false}}) {
    LeaderBeside of(100.0, share);
    of.Refit();
    EXPECT_EQ(WasFitted(of.toy, {of.alternative.effect}), tried) << share;
  }
}

// 1009.5 nat: a leader that is 15 nat behind is not refuted by 20.19, one that is 25 behind is.
TEST(RefitAlternatives, KeepsALeaderThatLostByLessThanAShareOfItsEvidence) {
  for (const auto& [ahead, kept] : {std::pair{15.0, 1U}, std::pair{25.0, 0U}}) {
    LeaderBeside of(45.0, 0.99);
    of.toy.fitted[{of.alternative.effect}] = -3.0 + ahead;
    of.Refit();
    EXPECT_EQ(of.found.causes.front().effect, of.alternative.effect);
    EXPECT_EQ(of.found.contenders.size(), kept) << ahead;
    EXPECT_NEAR(RankedAs(of.found, of.alternative).score, 1009.5 + ahead, 1e-9);
  }
}

TEST(RefitAlternatives, LeavesTheScoreOfTheScreenWhereNoFitFollows) {
  LeaderBeside of(10.0, 0.8);
  of.toy.refused.insert({of.alternative.effect});
  of.Refit();
  EXPECT_NEAR(RankedAs(of.found, of.alternative).score, 37.0, 1e-9);
  EXPECT_FALSE(RankedAs(of.found, of.alternative).refitted);
  EXPECT_EQ(of.found.causes.front().effect, of.leader.effect);
  EXPECT_TRUE(of.found.contenders.empty());
}

TEST(RefitAlternatives, WithoutCausesFitsNothing) {
  LeaderBeside of(10.0, 0.8);
  of.found = of.toy.Found({});
  of.Refit();
  EXPECT_TRUE(of.toy.fits.empty());
  EXPECT_EQ(of.found.candidates.size(), 2U);
}

// A search for one effect alone may rank none of the causes'.
TEST(RefitAlternatives, OfALeaderThatIsNoCandidateKnowsItsEvidenceAlone) {
  LeaderBeside of(10.0, 0.8);
  RankCandidates(of.toy, ThoroughRules(), of.found);
  std::erase_if(of.found.candidates,
                [&of](const Candidate& c) { return c.effect == of.leader.effect; });
  of.toy.fitted[{of.alternative.effect}] = 50.0;
  RefitAlternatives(of.toy, ThoroughRules(), of.found);
  EXPECT_EQ(of.found.causes.front().effect, of.leader.effect);
  EXPECT_NEAR(of.found.leader_evidence, -3.0, 1e-9);
}

TEST(RefitAlternatives, ReplaceTheFirstOfTwoAndKeepTheOther) {
  ToyLandscape toy({10.0, 0.0, 8.0});
  const Hypothesis leader = toy.Add(Id::kUnbalance, {1.0, 0.0, 0.0});
  const Hypothesis alternative = toy.Add(Id::kMisalignment, {0.95, 0.3, 0.0});
  const Hypothesis other = toy.Add(Id::kShaftBow, {0.0, 0.0, 1.0});
  toy.fitted[{alternative.effect, other.effect}] = -2.0;  // the leader's: -6
  CauseSelection found = toy.Found({leader, other});
  RankCandidates(toy, ThoroughRules(), found);
  RefitAlternatives(toy, ThoroughRules(), found);
  ASSERT_EQ(found.causes.size(), 2U);
  EXPECT_EQ(found.causes[0].effect, alternative.effect);
  EXPECT_EQ(found.causes[1].effect, other.effect);
  EXPECT_NEAR(found.point.theta[other.terms.front()], 8.0, 1e-9);
  EXPECT_NEAR(RankedAs(found, alternative).score, 47.0 + 4.0, 1e-9);
  ASSERT_EQ(found.contenders.size(), 1U);
  EXPECT_EQ(ToyLandscape::EffectsOf(found.contenders.front().causes),
            (Effects{leader.effect, other.effect}));
}

TEST(DropFailedLeader, KeepsOneWithoutWhichNoFitFollows) {
  ToyLandscape toy({10.0, 8.0});
  const Hypothesis leader = toy.Add(Id::kUnbalance, {1.0, 0.0});
  const Hypothesis other = toy.Add(Id::kShaftBow, {0.0, 1.0});
  CauseSelection found = toy.Found({leader, other});
  found.leader_evidence = -6.0;
  toy.fitted[{other.effect}] = -6.0;  // without a refusal it would not be needed
  toy.refused.insert({other.effect});
  EXPECT_FALSE(DropFailedLeader(toy, ThoroughRules(), found));
  EXPECT_EQ(found.causes.size(), 2U);
}

// 5 nat decide: a leader whose absence costs 4.9 goes, one of 5.1 stays.
TEST(DropFailedLeader, OfThreeGoesWhereTheOtherTwoLoseLessThanWhatDecides) {
  for (const auto& [cost, left] : {std::pair{4.9, 2U}, std::pair{5.1, 3U}}) {
    ToyLandscape toy({10.0, 8.0, 9.0});
    const Hypothesis leader = toy.Add(Id::kUnbalance, {1.0, 0.0, 0.0});
    const Hypothesis y = toy.Add(Id::kShaftBow, {0.0, 1.0, 0.0});
    const Hypothesis z = toy.Add(Id::kMisalignment, {0.0, 0.0, 1.0});
    CauseSelection found = toy.Found({leader, y, z});
    found.leader_evidence = -9.0;
    toy.fitted[{y.effect, z.effect}] = -9.0 - cost;
    EXPECT_EQ(DropFailedLeader(toy, ThoroughRules(), found), left == 2U);
    EXPECT_EQ(found.causes.size(), left) << cost;
    EXPECT_NEAR(found.point.theta[leader.terms.front()], left == 2U ? 0.0 : 10.0, 1e-9);
  }
}

}  // namespace
}  // namespace levitas::diagnosis

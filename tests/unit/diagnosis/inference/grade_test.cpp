// The verdict: what a residual makes of causes, and causes of a residual.

#include "diagnosis/inference/grade.hpp"

#include <gtest/gtest.h>

#include <utility>

namespace levitas::diagnosis {
namespace {

using effect::Id;

constexpr Id kLeader = Id::kUnbalance;
constexpr Id kNext = Id::kShaftBow;

/// A refitted leader of 100 nat that is named, and another effect behind it.
CauseSelection Led(double next_nat) {
  CauseSelection found;
  found.causes.resize(1);
  found.causes.front().effect = kLeader;
  found.candidates = {{kLeader, "disc", 100.0, 0, true}, {kNext, "mode 1", next_nat, 1, true}};
  return found;
}

Remainder Quiet() { return {3.0, 1.0}; }

/// Below the border of a line that stands out, and beyond it.
Remainder Broad(double explained) { return {20.0, explained}; }
Remainder Line(double explained) { return {1000.0, explained}; }

TEST(GradeOf, NothingNamedAndNothingLeftIsNone) {
  CauseSelection found;
  EXPECT_EQ(GradeOf({}, Quiet(), found), Verdict::kNone);
}

TEST(GradeOf, NothingNamedAndSomethingLeftIsUnknown) {
  CauseSelection found;
  EXPECT_EQ(GradeOf({}, Broad(1.0), found), Verdict::kUnknown);
}

TEST(GradeOf, ACauseThatLeavesNothingIsAnEffectUnlessDoubted) {
  CauseSelection found = Led(0.0);
  EXPECT_EQ(GradeOf({}, Quiet(), found), Verdict::kEffect);
  EXPECT_EQ(found.doubt, Doubt::kNothing);
  found.doubt = Doubt::kCutOff;
  found.probability = 0.7;
  EXPECT_EQ(GradeOf({}, Quiet(), found), Verdict::kSuspected);
  EXPECT_EQ(found.doubt, Doubt::kCutOff) << "the doubt that was there stays";
  EXPECT_EQ(found.probability, 0.7);
}

// What was not searched to the end is neither healthy nor proven.
TEST(GradeOf, AStoppedSearchNamesNothingAndClearsNobody) {
  CauseSelection none;
  none.stopped = true;
  EXPECT_EQ(GradeOf({}, Quiet(), none), Verdict::kUnknown);
  CauseSelection led = Led(0.0);
  led.stopped = true;
  EXPECT_EQ(GradeOf({}, Quiet(), led), Verdict::kSuspected);
  EXPECT_EQ(led.doubt, Doubt::kStopped);
  EXPECT_GT(led.probability, 0.99);
  CauseSelection doubted = Led(0.0);
  doubted.stopped = true;
  doubted.doubt = Doubt::kCutOff;
  EXPECT_EQ(GradeOf({}, Quiet(), doubted), Verdict::kSuspected);
  EXPECT_EQ(doubted.doubt, Doubt::kCutOff);
}

// Of a broad residual 70 % must be taken away, of a line 95 %.
TEST(GradeOf, MoreMustBeTakenAwayOfALineThatStandsOut) {
  for (const auto& [left, verdict] :
       {std::pair{Broad(0.71), Verdict::kEffect}, std::pair{Broad(0.69), Verdict::kUnknown},
        std::pair{Line(0.96), Verdict::kEffect}, std::pair{Line(0.71), Verdict::kUnknown}}) {
    CauseSelection found = Led(90.0);
    EXPECT_EQ(GradeOf({}, left, found), verdict) << left.sigma << " " << left.explained;
  }
}

TEST(GradeOf, ALeaderFarAheadIsSuspectedInSpiteOfWhatIsLeft) {
  CauseSelection far = Led(74.0);
  EXPECT_EQ(GradeOf({}, Broad(0.6), far), Verdict::kSuspected);
  EXPECT_EQ(far.doubt, Doubt::kResidualIsLeft);
  EXPECT_NEAR(far.probability, 0.6, 1e-3) << "of what is left, something else is the cause";
  CauseSelection near = Led(76.0);
  EXPECT_EQ(GradeOf({}, Broad(0.6), near), Verdict::kUnknown);
  EXPECT_EQ(near.doubt, Doubt::kNothing);
}

// A force at a fixed frequency leaves a line of thousands of deviations, of which the best effect
// of the vocabulary takes a few per cent.
TEST(GradeOf, ALeaderThatTakesAwayLessThanHalfIsNotSuspected) {
  for (const auto& [explained, verdict] :
       {std::pair{0.51, Verdict::kSuspected}, std::pair{0.49, Verdict::kUnknown},
        std::pair{0.03, Verdict::kUnknown}, std::pair{-0.2, Verdict::kUnknown}}) {
    CauseSelection found = Led(0.0);
    EXPECT_EQ(GradeOf({}, Line(explained), found), verdict) << explained;
    EXPECT_EQ(found.doubt == Doubt::kNothing, verdict == Verdict::kUnknown);
  }
}

TEST(GradeOf, ALeaderFarAheadMustBeTheNamedOneAndRefitted) {
  CauseSelection another = Led(0.0);
  another.causes.front().effect = kNext;
  EXPECT_EQ(GradeOf({}, Broad(0.6), another), Verdict::kUnknown);
  CauseSelection screened = Led(0.0);
  screened.candidates.front().refitted = false;
  EXPECT_EQ(GradeOf({}, Broad(0.6), screened), Verdict::kUnknown);
  CauseSelection none = Led(0.0);
  none.candidates.clear();
  EXPECT_EQ(GradeOf({}, Broad(0.6), none), Verdict::kUnknown);
}

TEST(GradeOf, AChainThatWasCutOffIsNotSuspected) {
  CauseSelection chain = Led(0.0);
  chain.causes.resize(3);
  EXPECT_EQ(GradeOf({}, Broad(0.6), chain), Verdict::kUnknown);
  chain.causes.resize(2);
  EXPECT_EQ(GradeOf({}, Broad(0.6), chain), Verdict::kSuspected);
  // Where one cause is all that may be found, one is no chain.
  SelectionRules one;
  one.most_causes = 1;
  chain.causes.resize(1);
  EXPECT_EQ(GradeOf(one, Broad(0.6), chain), Verdict::kSuspected);
}

// The next best may be worth less than nothing: that does not make the leader lead farther.
TEST(GradeOf, AnOnlyCandidateLeadsByItsOwnEvidence) {
  CauseSelection strong = Led(-50.0);
  strong.candidates.front().score = 26.0;
  EXPECT_EQ(GradeOf({}, Broad(0.6), strong), Verdict::kSuspected);
  for (const double next_nat : {-50.0, 0.0}) {
    CauseSelection weak = Led(next_nat);
    weak.candidates.front().score = 24.0;
    EXPECT_EQ(GradeOf({}, Broad(0.6), weak), Verdict::kUnknown) << next_nat;
  }
  strong.candidates.pop_back();
  EXPECT_EQ(GradeOf({}, Broad(0.6), strong), Verdict::kSuspected);
}

}  // namespace
}  // namespace levitas::diagnosis

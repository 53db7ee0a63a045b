// What is suspected at rest: a hum that its fit confirms or refutes, a number far from its file.

#include <gtest/gtest.h>

#include <cmath>

#include "diagnosis/inference/suspicion.hpp"
#include "tests/unit/diagnosis/rest_landscape.hpp"

namespace levitas::diagnosis {
namespace {

using effect::Id;

// The score is what the ranking says where the fit says more: P = 1 / (1 + e^-8), one candidate.
TEST(SuspectCause, TakesALeaderThatItsFitConfirms) {
  const RestLandscape& rest = Humming();
  CauseSelection found = rest.Calibrated();
  found.candidates = {rest.CandidateOf(Id::kMainsPickup, kHumPlace, 8.0)};
  SuspectCause(rest.landscape, Judging{}, found);
  ASSERT_EQ(found.causes.size(), 1U);
  EXPECT_EQ(found.causes.front().place, kHumPlace);
  EXPECT_EQ(found.doubt, Doubt::kWeakEvidence);
  EXPECT_NEAR(found.probability, 1.0 / (1.0 + std::exp(-8.0)), 1e-9);
  EXPECT_TRUE(found.candidates.front().refitted);
  double square = 0.0;
  for (const std::size_t term : found.causes.front().terms)
    square += std::pow(found.point.theta[term], 2);
  // Known to 1 um sqrt(2 / 3000): five of those.
  EXPECT_NEAR(std::sqrt(square), kHum,
              5.0 * kHumNoise * std::sqrt(2.0 / static_cast<double>(kRestCount)));
}

TEST(SuspectCause, LeavesALeaderThatItsFitRefutes) {
  const RestLandscape& rest = NothingWrong();
  CauseSelection found = rest.Calibrated();
  found.candidates = {rest.CandidateOf(Id::kMainsPickup, kHumPlace, 8.0)};
  SuspectCause(rest.landscape, Judging{}, found);
  EXPECT_TRUE(found.causes.empty());
  EXPECT_EQ(found.doubt, Doubt::kNothing);
  EXPECT_EQ(found.point, found.calibrated);
  EXPECT_LT(found.candidates.front().score, 0.0);
}

// The next one is not fitted: what leads only since another one failed is not likely by itself.
TEST(SuspectCause, LeavesALeaderThatFallsBehindAnother) {
  const RestLandscape& rest = NothingWrong();
  CauseSelection found = rest.Calibrated();
  found.candidates = {rest.CandidateOf(Id::kMainsPickup, kHumPlace, 8.0),
                      rest.CandidateOf(Id::kSensorOffset, "de_x", 6.0)};
  SuspectCause(rest.landscape, Judging{}, found);
  EXPECT_TRUE(found.causes.empty());
  ASSERT_EQ(found.candidates.size(), 2U);
  EXPECT_EQ(found.candidates.front().place, "de_x");
  EXPECT_FALSE(found.candidates.front().refitted);
}

TEST(SuspectCause, LeavesWhatIsNotLikelyUnfitted) {
  const RestLandscape& rest = NothingWrong();
  CauseSelection found = rest.Calibrated();
  found.candidates = {rest.CandidateOf(Id::kMainsPickup, kHumPlace, -1.0)};
  SuspectCause(rest.landscape, Judging{}, found);
  EXPECT_TRUE(found.causes.empty());
  EXPECT_FALSE(found.candidates.front().refitted);
}

TEST(SuspectCause, AddsNothingToACause) {
  const RestLandscape& rest = NothingWrong();
  CauseSelection found = rest.Calibrated();
  found.causes = {rest.Of(Id::kUnbalance, "all places")};
  found.candidates = {rest.CandidateOf(Id::kMainsPickup, kHumPlace, 8.0)};
  SuspectCause(rest.landscape, Judging{}, found);
  EXPECT_EQ(found.causes.size(), 1U);
  EXPECT_FALSE(found.candidates.front().refitted);
}

/// Nothing is likely; the offset of de_x is calibrated to so many tolerances.
CauseSelection SuspectedAt(double tolerances) {
  const RestLandscape& rest = NothingWrong();
  CauseSelection found = rest.Calibrated();
  found.calibrated.theta.assign(found.calibrated.theta.size(), 0.0);
  found.calibrated.theta[rest.TermOf(Id::kSensorOffset, "de_x")] = tolerances * kOffsetTolerance;
  found.candidates = {rest.CandidateOf(Id::kMainsPickup, kHumPlace, -1.0),
                      rest.CandidateOf(Id::kSensorOffset, "de_y", -2.0)};
  SuspectCause(rest.landscape, Judging{}, found);
  return found;
}

// Four offsets are determined: 1 - (1 - 2.7e-3)^4 = 0.0108 for one beyond 3, 0.055 beyond 2.45.
TEST(SuspectNumber, TakesTheEffectOfOneThatChanceBringsThereInOneOfTwentyRigsAtMost) {
  const CauseSelection found = SuspectedAt(3.0);
  ASSERT_EQ(found.causes.size(), 1U);
  EXPECT_EQ(found.causes.front().place, "de_x") << "alone, not with other axes";
  EXPECT_EQ(found.causes.front().terms.size(), 1U);
  EXPECT_EQ(found.doubt, Doubt::kMovedNumber);
  EXPECT_NEAR(found.probability, std::pow(1.0 - 2.69979606e-3, 4), 1e-9);
  EXPECT_TRUE(SuspectedAt(2.45).causes.empty());
  EXPECT_TRUE(SuspectedAt(-2.45).causes.empty());
}

TEST(SuspectNumber, LeadsTheCandidatesWithItsOwnPlace) {
  const CauseSelection found = SuspectedAt(-6.0);
  ASSERT_EQ(found.candidates.size(), 2U);
  EXPECT_EQ(found.candidates[0].effect, found.causes.front().effect);
  EXPECT_EQ(found.candidates[0].place, "de_x");
  EXPECT_EQ(found.candidates[0].hypothesis, NothingWrong().IndexOf(Id::kSensorOffset, "de_x"));
  EXPECT_EQ(found.candidates[1].place, kHumPlace);
}

}  // namespace
}  // namespace levitas::diagnosis

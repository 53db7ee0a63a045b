// A probe at rest that reads beside where its file says, by known numbers of tolerances.

#include <gtest/gtest.h>

#include <cmath>

#include "diagnosis/inference/moved_calibration.hpp"
#include "tests/unit/diagnosis/rest_landscape.hpp"

namespace levitas::diagnosis {
namespace {

using effect::Id;

SelectionRules NamingRules(std::size_t most_causes = 3) {
  SelectionRules rules;
  rules.effort = {5, 3, 3, 2, kMostRows, false};
  rules.most_causes = most_causes;
  return rules;
}

/// [nat] by which the effect explains an offset that the data know better than a tolerance does:
/// the penalties of both priors, their widths, and one of eight places.
double GainOfOffset(double offset_m) {
  const double healthy = std::pow(kOffsetTolerance, 2);
  const double faulty = healthy + std::pow(kUsualOffset, 2);
  return 0.5 * offset_m * offset_m * (1.0 / healthy - 1.0 / faulty) -
         0.5 * std::log(faulty / healthy) - std::log(8.0);
}

TEST(NameMovedCalibration, NamesAnOffsetOfFourTolerancesAndWhatItIsWorth) {
  const RestLandscape& rest = FourTolerances();
  CauseSelection found = rest.Calibrated();
  const std::size_t term = rest.TermOf(Id::kSensorOffset, "de_x");
  found.candidates = {rest.CandidateOf(Id::kMainsPickup, kHumPlace, 0.5),
                      rest.CandidateOf(Id::kSensorOffset, "de_y", 1.0)};
  NameMovedCalibration(rest.landscape, NamingRules(), found);
  ASSERT_EQ(found.causes.size(), 1U);
  EXPECT_EQ(found.causes.front().place, "de_x");
  EXPECT_NEAR(found.point.theta[term], 4.0 * kOffsetTolerance, 0.1 * kOffsetTolerance);
  ASSERT_EQ(found.candidates.size(), 2U) << "in the place of its own effect's";
  EXPECT_EQ(found.candidates.front().place, "de_x");
  EXPECT_EQ(found.candidates.front().hypothesis, rest.IndexOf(Id::kSensorOffset, "de_x"));
  EXPECT_TRUE(found.candidates.front().refitted);
  // The load of 0.01 N and the noise leave 1 % of a tolerance: 4 * 0.01 and its square.
  EXPECT_NEAR(found.candidates.front().score, GainOfOffset(4.0 * kOffsetTolerance), 0.3);
}

TEST(NameMovedCalibration, LeavesAnOffsetWithinThreeTolerances) {
  const RestLandscape rest(0.0, 2.8 * kOffsetTolerance);
  CauseSelection found = rest.Calibrated();
  NameMovedCalibration(rest.landscape, NamingRules(), found);
  EXPECT_TRUE(found.causes.empty());
  EXPECT_TRUE(found.candidates.empty());
}

TEST(NameMovedCalibration, NamesNoMoreThanThereMayBeCauses) {
  const RestLandscape& rest = FourTolerances();
  CauseSelection found = rest.Calibrated();
  NameMovedCalibration(rest.landscape, NamingRules(0), found);
  EXPECT_TRUE(found.causes.empty());
}

// 5 nat decide; the file's number must be refused by them though the effect is preferred anyway.
TEST(NameMovedCalibration, AsksThatTheDataRefuseTheFile) {
  const RestLandscape& rest = FourTolerances();
  CauseSelection found = rest.Calibrated();
  SelectionRules rules = NamingRules();
  // 4 tolerances, of which a hundredth is not known: 0.5 * 400^2.
  rules.judging.decisive_nat = 1e6;
  NameMovedCalibration(rest.landscape, rules, found);
  EXPECT_TRUE(found.causes.empty());
}

TEST(NameMovedCalibration, AddsToACauseAndLeavesTheRankingOfTheFirst) {
  const RestLandscape& rest = FourTolerances();
  CauseSelection found = rest.Calibrated();
  found.causes = {rest.Of(Id::kMainsPickup, kHumPlace)};
  found.candidates = {rest.CandidateOf(Id::kMainsPickup, kHumPlace, 9.0)};
  NameMovedCalibration(rest.landscape, NamingRules(), found);
  ASSERT_EQ(found.causes.size(), 2U);
  EXPECT_EQ(found.causes.back().place, "de_x");
  EXPECT_EQ(found.candidates.size(), 1U);
}

TEST(NameMovedCalibration, LeavesWhatACauseMoves) {
  const RestLandscape& rest = FourTolerances();
  CauseSelection found = rest.Calibrated();
  found.causes = {rest.Of(Id::kSensorOffset, "de")};  // both axes of the bearing
  NameMovedCalibration(rest.landscape, NamingRules(), found);
  EXPECT_EQ(found.causes.size(), 1U);
}

// A hum that is not in the records, named before the offset that is.
TEST(DropNeedless, LeavesTheCauseThatTheDataAskForAndRanksIt) {
  const RestLandscape& rest = FourTolerances();
  CauseSelection found = rest.Calibrated();
  found.causes = {rest.Of(Id::kMainsPickup, kHumPlace), rest.Of(Id::kSensorOffset, "de_x")};
  found.point = rest.landscape.SolutionOf(found.causes);
  found.candidates = {rest.CandidateOf(Id::kMainsPickup, kHumPlace, 9.0)};
  CauseSelection older = found;
  DropNeedless(rest.landscape, NamingRules(), 0, found);
  ASSERT_EQ(found.causes.size(), 1U);
  EXPECT_EQ(found.causes.front().place, "de_x");
  ASSERT_EQ(found.candidates.size(), 1U);
  EXPECT_EQ(found.candidates.front().effect, Id::kSensorOffset);
  EXPECT_NEAR(found.candidates.front().score, GainOfOffset(4.0 * kOffsetTolerance), 0.3);
  DropNeedless(rest.landscape, NamingRules(), 1, older);
  EXPECT_EQ(older.causes.size(), 2U) << "a cause found before is not asked";
}

TEST(DropNeedless, KeepsWhatTheDataAskFor) {
  const RestLandscape& rest = FourTolerances();
  CauseSelection found = rest.Calibrated();
  found.causes = {rest.Of(Id::kSensorOffset, "de_x"), rest.Of(Id::kMainsPickup, kHumPlace)};
  found.point = rest.landscape.SolutionOf(found.causes);
  DropNeedless(rest.landscape, NamingRules(), 0, found);
  EXPECT_EQ(found.causes.size(), 2U);
}

}  // namespace
}  // namespace levitas::diagnosis

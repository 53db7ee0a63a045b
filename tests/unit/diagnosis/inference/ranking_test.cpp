// What a ranking says of its candidates, on runs and candidates made by hand.

#include "diagnosis/inference/ranking.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/unit/diagnosis/trajectories.hpp"

namespace levitas::diagnosis {
namespace {

Hypothesis Named(effect::Id effect) {
  Hypothesis h;
  h.effect = effect;
  return h;
}

TEST(BestOfEachEffect, KeepsTheBestPlaceAndLeavesOutWhatIsNotFinite) {
  const std::vector<Hypothesis> hypotheses{
      Named(effect::Id::kUnbalance), Named(effect::Id::kShaftBow), Named(effect::Id::kUnbalance),
      Named(effect::Id::kRotorMass)};
  const std::vector<Candidate> best =
      BestOfEachEffect(hypotheses, {3.0, 7.0, 9.0, -std::numeric_limits<double>::infinity()});
  ASSERT_EQ(best.size(), 2U);
  EXPECT_EQ(best[0].effect, effect::Id::kUnbalance);
  EXPECT_EQ(best[0].hypothesis, 2U);
  EXPECT_EQ(best[0].score, 9.0);
  EXPECT_EQ(best[1].effect, effect::Id::kShaftBow);
}

/// Noise of which every sixth sample is validation data; `factor` is on those alone.
std::vector<Trajectory> ValidationRuns(double factor) {
  return {NoiseRun(7, 12'000, [factor](std::size_t n, SamplePoint& m) {
    m.held = n % 6 == 0;
    m.counts = !m.held;
    if (!m.held) return;
    for (float& value : m.innovation_m) value *= static_cast<float>(factor);
  })};
}

TEST(RankingTest, TiesAreAllWithinTheDecisiveMargin) {
  const std::vector<Candidate> candidates{{effect::Id::kUnbalance, "", 20.0, 0, true},
                                          {effect::Id::kShaftBow, "", 16.0, 1, true},
                                          {effect::Id::kRotorMass, "", 14.0, 2, true}};
  EXPECT_EQ(Ties(candidates, {Named(effect::Id::kUnbalance)}, 5.0, 0.0),
            std::vector<effect::Id>{effect::Id::kShaftBow});
}

TEST(RankingTest, StrongCausesTieWithinAShareOfTheirEvidence) {
  const std::vector<Candidate> candidates{{effect::Id::kSensorRunout, "", 10'000.0, 0, true},
                                          {effect::Id::kMisalignment, "", 9'900.0, 1, true},
                                          {effect::Id::kShaftBow, "", 9'700.0, 2, true},
                                          {effect::Id::kMainsPickup, "", 9'950.0, 3, false}};
  // What was only screened is not known so exactly.
  EXPECT_EQ(Ties(candidates, {Named(effect::Id::kSensorRunout)}, 5.0, 0.02),
            std::vector<effect::Id>{effect::Id::kMisalignment});
}

TEST(RankingTest, WhatValidationDataRefuteIsNoTie) {
  std::vector<Candidate> candidates{{effect::Id::kSensorRunout, "", 10'000.0, 0, true},
                                    {effect::Id::kMisalignment, "", 9'900.0, 1, true}};
  candidates[0].validation_nat = -4000.0;
  candidates[1].validation_nat = 3000.0;
  EXPECT_TRUE(Ties(candidates, {Named(effect::Id::kMisalignment)}, 5.0, 0.02).empty());
  candidates[0].validation_nat = 3000.0;
  EXPECT_EQ(Ties(candidates, {Named(effect::Id::kMisalignment)}, 5.0, 0.02),
            std::vector<effect::Id>{effect::Id::kSensorRunout});
}

TEST(RankingTest, ACauseThatIsNotNamedForItsEvidenceHasNoTies) {
  const std::vector<Candidate> candidates{{effect::Id::kShaftBow, "", 4.0, 1, true},
                                          {effect::Id::kCurrentGain, "", 1.9, 0, true}};
  EXPECT_TRUE(Ties(candidates, {Named(effect::Id::kCurrentGain)}, 5.0, 0.0).empty());
}

TEST(RankingTest, ACauseOfItsOwnIsNoTie) {
  const std::vector<Candidate> candidates{{effect::Id::kUnbalance, "", 20.0, 0, true},
                                          {effect::Id::kShaftBow, "", 16.0, 1, true}};
  EXPECT_TRUE(
      Ties(candidates, {Named(effect::Id::kUnbalance), Named(effect::Id::kShaftBow)}, 5.0, 0.0)
          .empty());
}

TEST(RankingTest, AModelThatIsWorseOnValidationDataLoses) {
  const auto before = ValidationRuns(1.0);
  const Whitener whitener = MakeWhitener(before, TheRig().axes, 0);
  // 2000 samples of four axes: half of 21 % more power of each.
  EXPECT_NEAR(HeldGain(before, ValidationRuns(1.1), whitener), -0.5 * 0.21 * 8000.0, 40.0);
  EXPECT_NEAR(HeldGain(ValidationRuns(1.1), before, whitener), 0.5 * 0.21 * 8000.0, 40.0);
}

TEST(RankingTest, WithoutValidationDataNothingIsGainedOrLost) {
  const std::vector<Trajectory> runs{NoiseRun(8, 2000)};
  const Whitener whitener = MakeWhitener(runs, TheRig().axes, 0);
  EXPECT_EQ(HeldGain(runs, {NoiseRun(9, 2000)}, whitener), 0.0);
}

}  // namespace
}  // namespace levitas::diagnosis

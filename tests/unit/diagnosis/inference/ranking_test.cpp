// What a ranking says of its candidates, on runs and candidates made by hand.

#include "diagnosis/inference/ranking.hpp"

#include <gtest/gtest.h>

#include "tests/unit/diagnosis/trajectories.hpp"

namespace levitas::diagnosis {
namespace {

Hypothesis Named(const std::string& effect) {
  Hypothesis h;
  h.effect = effect;
  return h;
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
  const std::vector<Candidate> candidates{{"unbalance", "", 20.0, 0, true},
                                          {"shaft_bow", "", 16.0, 1, true},
                                          {"rotor_mass", "", 14.0, 2, true}};
  EXPECT_EQ(Ties(candidates, {Named("unbalance")}, 5.0, 0.0),
            std::vector<std::string>{"shaft_bow"});
}

TEST(RankingTest, StrongCausesTieWithinAShareOfTheirEvidence) {
  const std::vector<Candidate> candidates{{"sensor_runout", "", 10'000.0, 0, true},
                                          {"misalignment", "", 9'900.0, 1, true},
                                          {"shaft_bow", "", 9'700.0, 2, true},
                                          {"mains_pickup", "", 9'950.0, 3, false}};
  // What was only screened is not known so exactly.
  EXPECT_EQ(Ties(candidates, {Named("sensor_runout")}, 5.0, 0.02),
            std::vector<std::string>{"misalignment"});
}

TEST(RankingTest, WhatValidationDataRefuteIsNoTie) {
  std::vector<Candidate> candidates{{"sensor_runout", "", 10'000.0, 0, true},
                                    {"misalignment", "", 9'900.0, 1, true}};
  candidates[0].validation_nat = -4000.0;
  candidates[1].validation_nat = 3000.0;
  EXPECT_TRUE(Ties(candidates, {Named("misalignment")}, 5.0, 0.02).empty());
  candidates[0].validation_nat = 3000.0;
  EXPECT_EQ(Ties(candidates, {Named("misalignment")}, 5.0, 0.02),
            std::vector<std::string>{"sensor_runout"});
}

TEST(RankingTest, ACauseThatIsNotNamedForItsEvidenceHasNoTies) {
  const std::vector<Candidate> candidates{{"shaft_bow", "", 4.0, 1, true},
                                          {"current_gain", "", 1.9, 0, true}};
  EXPECT_TRUE(Ties(candidates, {Named("current_gain")}, 5.0, 0.0).empty());
}

TEST(RankingTest, ACauseOfItsOwnIsNoTie) {
  const std::vector<Candidate> candidates{{"unbalance", "", 20.0, 0, true},
                                          {"shaft_bow", "", 16.0, 1, true}};
  EXPECT_TRUE(Ties(candidates, {Named("unbalance"), Named("shaft_bow")}, 5.0, 0.0).empty());
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

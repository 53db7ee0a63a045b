// What is more likely than not, from candidates and calibrated numbers made by hand.

#include "diagnosis/inference/suspicion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

namespace levitas::diagnosis {
namespace {

constexpr double kTie = 5.0;

/// Effects of which the first has that evidence and the others explain nothing.
std::vector<Candidate> Leading(double nat, std::size_t effects) {
  std::vector<Candidate> all(effects);
  for (Candidate& c : all) c.score = -20.0;
  all.front().score = nat;
  return all;
}

TEST(Suspicion, OfOneAmongManyEffectsNeedsMoreThanTheirNumber) {
  // Prior 1/N each: even odds at ln N.
  EXPECT_NEAR(ProbabilityOfLeader(Leading(std::log(34.0), 34), kTie), 0.5, 1e-6);
  EXPECT_LT(ProbabilityOfLeader(Leading(2.0, 34), kTie), 0.2);
  EXPECT_GT(ProbabilityOfLeader(Leading(4.5, 34), kTie), 0.7);
}

TEST(Suspicion, CountsWhatTheDataDoNotSeparateTogether) {
  std::vector<Candidate> two = Leading(3.2, 34);
  const double alone = ProbabilityOfLeader(two, kTie);
  two[1].score = 3.2;
  EXPECT_LT(alone, 0.5);
  EXPECT_NEAR(ProbabilityOfLeader(two, kTie), 2.0 * alone / (1.0 + alone), 1e-9);
}

// With nothing hidden, what has no evidence has its prior left, half of all together: that is no
// reason to suspect the one in front of it.
TEST(Suspicion, IsNotRaisedByEffectsThatTheDataSayNothingOf) {
  std::vector<Candidate> others = Leading(3.2, 34);
  const double alone = ProbabilityOfLeader(others, kTie);
  for (std::size_t i = 1; i < others.size(); ++i) others[i].score = 0.0;
  EXPECT_LT(ProbabilityOfLeader(others, kTie), alone);
  EXPECT_LT(alone, 0.5);
}

TEST(Suspicion, OfNothingIsNone) {
  EXPECT_EQ(ProbabilityOfLeader({}, kTie), 0.0);
  std::vector<Candidate> impossible(2);
  impossible[0].score = impossible[1].score = -INFINITY;
  EXPECT_EQ(ProbabilityOfLeader(impossible, kTie), 0.0);
}

TEST(Suspicion, ChanceOfOneOfManyNumbers) {
  // Two-sided tails of the normal distribution: 2.7e-3 beyond 3, 0.0455 beyond 2.
  EXPECT_NEAR(ChanceOfOne(3.0, 1), 2.69979606e-3, 1e-10);
  EXPECT_NEAR(ChanceOfOne(2.0, 20), 1.0 - std::pow(1.0 - 0.04550026, 20), 1e-6);
  EXPECT_EQ(ChanceOfOne(3.0, 0), 0.0);
}

/// Numbers of an effect with unit tolerance; the data leave `deviation` of each.
std::optional<MovedNumber> Furthest(const std::vector<double>& theta,
                                    const std::vector<double>& deviation) {
  Term term;
  term.effect = effect::Id::kCurrentGain;
  term.tolerance = 1.0;
  term.faulty_std = 4.0;
  Fit fit;
  fit.deviation.resize(static_cast<Eigen::Index>(theta.size()));
  for (std::size_t i = 0; i < theta.size(); ++i) {
    fit.deviation[static_cast<Eigen::Index>(i)] = deviation[i] / term.scale();
  }
  return FurthestNumber(std::vector<Term>(theta.size(), term), fit, theta);
}

TEST(Suspicion, IsOfTheFurthestNumberThatTheDataDetermine) {
  const auto moved = Furthest({1.0, -3.5, 4.0}, {0.1, 0.1, 0.9});
  ASSERT_TRUE(moved.has_value());
  EXPECT_EQ(moved->term, 1U);
  EXPECT_NEAR(moved->tolerances, 3.5, 1e-12);
  // Two numbers are determined: the third has no chance to be far.
  EXPECT_NEAR(moved->chance, ChanceOfOne(3.5, 2), 1e-12);
}

TEST(Suspicion, IsOfNoNumberThatTheDataDoNotDetermine) {
  EXPECT_FALSE(Furthest({5.0, -6.0}, {0.8, 1.0}).has_value());
}

}  // namespace
}  // namespace levitas::diagnosis

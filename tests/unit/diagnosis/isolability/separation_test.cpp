// What is foretold of a signature, against closed forms of three terms made by hand.

#include "diagnosis/isolability/separation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "diagnosis/isolability/foretell.hpp"

namespace levitas::diagnosis {
namespace {

using effect::Id;

/// A nuisance and two causes of one term each.
std::vector<Term> ThreeTerms() {
  return {MakeTerm({std::nullopt, Everywhere("anywhere"), "nuisance", "1"}, 1.0, 1.0, nullptr),
          MakeTerm({Id::kUnbalance, Everywhere("here"), "size", "1"}, 0.0, 1.0, nullptr),
          MakeTerm({Id::kShaftBow, Everywhere("there"), "size", "1"}, 0.0, 1.0, nullptr)};
}

Hypothesis Moving(Id effect, Eigen::Index term) {
  Hypothesis h;
  h.effect = effect;
  h.place = "somewhere";
  h.directions = Eigen::MatrixXd::Zero(3, 1);
  h.directions(term, 0) = 1.0;
  h.terms = {static_cast<std::size_t>(term)};
  return h;
}

std::vector<Hypothesis> Causes() { return {Moving(Id::kUnbalance, 1), Moving(Id::kShaftBow, 2)}; }

/// Slopes of unit columns times 10, with cosines between nuisance and first, and first and second
/// cause; the fault is `size` of the first cause.
LinearProblem Signature(double with_nuisance, double with_second, double size) {
  LinearProblem p;
  p.jtj = 100.0 * Eigen::MatrixXd::Identity(3, 3);
  p.jtj(0, 1) = p.jtj(1, 0) = 100.0 * with_nuisance;
  p.jtj(1, 2) = p.jtj(2, 1) = 100.0 * with_second;
  const Eigen::Vector3d fault(0.0, size, 0.0);
  p.jte = -p.jtj * fault;
  p.ete = fault.dot(p.jtj * fault);
  p.values = 1000;
  return p;
}

Prediction Of(const LinearProblem& signature) {
  return Predict(Id::kUnbalance, signature, ThreeTerms(), Causes(), Judging{});
}

TEST(Separation, ASignatureThatNothingElseHasIsFoundWithHalfItsSquaredNorm) {
  const Prediction p = Of(Signature(0.0, 0.0, 1.0));
  EXPECT_NEAR(p.detectable_nat, 50.0, 1e-9);
  EXPECT_EQ(p.isolation, Isolation::kFound);
  ASSERT_EQ(p.alternatives.size(), 1U);
  EXPECT_NEAR(p.alternatives[0].left_nat, 50.0, 1e-9) << "the other cause takes nothing of it";
}

TEST(Separation, WhatCalibrationMayTakeIsNotVisible) {
  // The nuisance does the same: all that is left is what its tolerance costs, (1)^2/2, and a bit.
  const Prediction p = Of(Signature(1.0, 0.0, 1.0));
  EXPECT_EQ(p.isolation, Isolation::kNotVisible);
  EXPECT_NEAR(p.detectable_nat, 0.5 * 100.0 / 101.0, 1e-9);
}

TEST(Separation, CausesOfTheSameSignatureAreTiedAndLeaveNothingOfEachOther) {
  const Prediction p = Of(Signature(0.0, 1.0, 1.0));
  EXPECT_EQ(p.isolation, Isolation::kTied);
  EXPECT_EQ(p.ties, std::vector<Id>{Id::kShaftBow});
  EXPECT_LT(p.alternatives[0].left_nat, 1.0);
}

TEST(Separation, GrowsWithTheFaultUntilASimilarCauseIsNoTieAnyMore) {
  constexpr double kSimilar = 0.95;
  EXPECT_EQ(Of(Signature(0.0, kSimilar, 0.1)).isolation, Isolation::kNotVisible);
  EXPECT_EQ(Of(Signature(0.0, kSimilar, 0.8)).isolation, Isolation::kTied);
  EXPECT_EQ(Of(Signature(0.0, kSimilar, 3.0)).isolation, Isolation::kFound);
}

TEST(Separation, TheShareOfTheSizeFromWhichItIsVisibleMakesItJustDecisive) {
  const Prediction clear = Of(Signature(0.0, 0.0, 1.0));
  const Prediction less = Of(Signature(0.0, 0.0, clear.visible_from));
  EXPECT_NEAR(less.evidence_nat, Judging{}.decisive_nat, 0.6)
      << "the prior of the size is left out";
  EXPECT_NEAR(less.probability, 0.5, 0.1);
}

TEST(Separation, AnEventIsVisibleByItsEvidenceAloneAndTiedWithNothing) {
  EXPECT_EQ(PredictEvent(Id::kSensorNoise, 4.0, Judging{}).isolation, Isolation::kNotVisible);
  EXPECT_EQ(PredictEvent(Id::kSensorNoise, 6.0, Judging{}).isolation, Isolation::kFound);
}

Foretold Tied(Id effect, std::vector<Id> with) {
  Foretold one;
  one.prediction.effect = effect;
  one.prediction.ties = std::move(with);
  return one;
}

TEST(TiedGroups, HoldAllThatHangTogetherAndNoneThatStandsAlone) {
  const auto groups = TiedGroups(
      {Tied(Id::kAmplifierSlew, {Id::kBacklash}), Tied(Id::kCurrentGain, {Id::kExtraDelay}),
       Tied(Id::kBacklash, {Id::kCurrentGain}), Tied(Id::kHysteresis, {}),
       Tied(Id::kRotorMass, {Id::kUnbalance})});
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_EQ(groups[0], (std::vector<Id>{Id::kAmplifierSlew, Id::kBacklash, Id::kCurrentGain,
                                        Id::kExtraDelay}));
  EXPECT_EQ(groups[1], (std::vector<Id>{Id::kRotorMass, Id::kUnbalance}));
}

}  // namespace
}  // namespace levitas::diagnosis

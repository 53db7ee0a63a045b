// Evidence of a cause against the closed forms of Bayesian linear regression.

#include "diagnosis/inference/evidence.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include <cmath>
#include <limits>

namespace levitas::diagnosis {
namespace {

/// A nuisance and a cause with the given overlap; the data are explained by `truth` of the cause.
LinearProblem Problem(double overlap, double truth) {
  LinearProblem p;
  p.jtj = Eigen::MatrixXd(2, 2);
  p.jtj << 100.0, overlap, overlap, 100.0;
  const Eigen::Vector2d theta(0.0, truth);
  p.jte = -p.jtj * theta;
  p.ete = 1000.0 + theta.dot(p.jtj * theta);
  p.values = 1000;
  return p;
}

std::vector<Term> TwoTerms() {
  return {
      MakeTerm({std::nullopt, Everywhere("anywhere"), "nuisance", "1"}, 1.0, 1.0, nullptr),
      MakeTerm({effect::Id::kRotorMass, Everywhere("somewhere"), "size", "1"}, 0.0, 1.0, nullptr)};
}

Hypothesis Cause(bool positive = false) {
  Hypothesis h;
  h.effect = effect::Id::kRotorMass;
  h.place = "somewhere";
  h.directions = Eigen::MatrixXd::Zero(2, 1);
  h.directions(1, 0) = 1.0;
  h.terms = {1};
  h.positive = positive;
  return h;
}

TEST(Evidence, OfACauseThatNothingElseExplainsIsTheClosedForm) {
  const LinearProblem problem = Problem(0.0, 0.5);
  // r = 50, S + 1 = 101: 1/2 r^2/(S+1) - 1/2 ln(S+1).
  const double expected = 0.5 * 2500.0 / 101.0 - 0.5 * std::log(101.0);
  EXPECT_NEAR(Evidence(problem, TwoTerms(), {}).Gain(Cause()), expected, 1e-9);
}

TEST(Evidence, OfNothingIsWhatFreedomCosts) {
  EXPECT_NEAR(Evidence(Problem(0.0, 0.0), TwoTerms(), {}).Gain(Cause()), -0.5 * std::log(101.0),
              1e-9);
}

TEST(Evidence, FallsWhenATolerancedParameterExplainsTheSame) {
  const auto gain = [](double overlap) {
    return Evidence(Problem(overlap, 0.5), TwoTerms(), {}).Gain(Cause());
  };
  EXPECT_GT(gain(0.0), gain(60.0));
  EXPECT_GT(gain(60.0), gain(99.0));
  EXPECT_LT(gain(99.9), 1.0);
}

TEST(Evidence, EqualsTheDifferenceOfTheTwoFits) {
  const LinearProblem problem = Problem(40.0, 0.5);
  const auto terms = TwoTerms();
  const double with = Evidence(problem, terms, {Cause()}).Solve().log_evidence;
  const double without = Evidence(problem, terms, {}).Solve().log_evidence;
  EXPECT_NEAR(Evidence(problem, terms, {}).Gain(Cause()), with - without, 1e-9);
}

TEST(Evidence, RefusesACauseThatWouldHaveToBeNegative) {
  const LinearProblem problem = Problem(0.0, -0.5);
  const double never = -std::numeric_limits<double>::infinity();
  EXPECT_EQ(Evidence(problem, TwoTerms(), {}).Gain(Cause(true)), never);
  EXPECT_GT(Evidence(problem, TwoTerms(), {}).Gain(Cause(false)), 5.0);
}

TEST(Evidence, StepsFromAnywhereToTheSolutionWhenNothingHoldsItBack) {
  const LinearProblem problem = Problem(40.0, 0.5);
  const auto terms = TwoTerms();
  const Evidence evidence(problem, terms, {Cause()});
  const Eigen::Vector2d from(-0.7, 1.2);
  EXPECT_NEAR((evidence.Step(from, 0.0) - evidence.Solve().theta).norm(), 0.0, 1e-6);
}

// What the data say little about moves little; what they determine goes nearly all the way.
TEST(Evidence, HoldsBackOnlyWhatTheDataDoNotDetermine) {
  LinearProblem problem = Problem(0.0, 0.5);
  constexpr double kWeak = 1e-2;  // of its prior
  problem.jtj(0, 0) = kWeak;
  problem.jte[0] = -1.0;
  const auto terms = TwoTerms();
  const Evidence evidence(problem, terms, {Cause()});
  const Eigen::Vector2d origin(0.0, 0.0);
  const Eigen::VectorXd whole = evidence.Step(origin, 0.0);
  const Eigen::VectorXd held = evidence.Step(origin, 9.0);
  // 1 / (kWeak + 1) against 1 / (kWeak + 10), and 50 / 101 against 50 / 110.
  EXPECT_NEAR(held[0] / whole[0], (kWeak + 1.0) / (kWeak + 10.0), 1e-6);
  EXPECT_NEAR(held[1] / whole[1], 101.0 / 110.0, 1e-6);
}

// A parameter beside the others, told by its products, goes where it would as one of them.
TEST(Evidence, StepsBesideAsIfTheParameterWereOneOfItsOwn) {
  const LinearProblem whole = Problem(40.0, 0.5);
  const std::vector<Term> terms{
      MakeTerm({std::nullopt, Everywhere("anywhere"), "nuisance", "1"}, 1.0, 1.0, nullptr)};
  LinearProblem part;
  part.jtj = whole.jtj.topLeftCorner(1, 1);
  part.jte = whole.jte.head(1);
  part.ete = whole.ete;
  const Eigen::VectorXd origin = Eigen::VectorXd::Zero(1);
  const Eigen::VectorXd cross = whole.jtj.block(0, 1, 1, 1);
  const auto beside =
      Evidence(part, terms, {}).StepBeside(origin, cross, whole.jte[1], whole.jtj(1, 1), 10.0);
  // Without a prior of its own: (101 n + 40 s, 40 n + 100 s) = -jte.
  Eigen::Matrix2d normal = whole.jtj;
  normal(0, 0) += 1.0;
  const Eigen::Vector2d expected = normal.llt().solve(-whole.jte);
  EXPECT_NEAR(beside.theta[0], expected[0], 1e-6);
  EXPECT_NEAR(beside.step, expected[1], 1e-6);
  EXPECT_NEAR(
      Evidence(part, terms, {}).StepBeside(origin, cross, whole.jte[1], whole.jtj(1, 1), 0.1).step,
      0.1, 1e-12);
}

TEST(AtOrigin, GivesTheSameProblemWhereverTheModelWasLinearised) {
  const LinearProblem truth = Problem(40.0, 0.5);
  const Eigen::Vector2d point(0.3, -0.2);
  NormalEquations there;
  there.jtj = truth.jtj;
  there.jte = truth.jte + truth.jtj * point;
  there.ete = truth.ete + 2.0 * point.dot(truth.jte) + point.dot(truth.jtj * point);
  const LinearProblem back = AtOrigin(there, point);
  EXPECT_NEAR((back.jte - truth.jte).norm(), 0.0, 1e-9);
  EXPECT_NEAR(back.ete, truth.ete, 1e-9);
}

}  // namespace
}  // namespace levitas::diagnosis

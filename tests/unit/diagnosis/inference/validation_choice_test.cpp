// Which contender the validation data choose, and how other data move what these leave open.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "diagnosis/inference/evidence.hpp"
#include "diagnosis/inference/validation.hpp"

namespace levitas::diagnosis {
namespace {

TEST(ValidationChoice, IsTheBestOfThoseThatGainBeyondTheirScatter) {
  EXPECT_EQ(Choose({{10.0, 2.0}, {40.0, 3.0}, {90.0, 80.0}}, 1.645), 1U);
}

TEST(ValidationChoice, StaysWithTheLeaderWhenNoneGains) {
  EXPECT_FALSE(Choose({}, 1.645).has_value());
  EXPECT_FALSE(Choose({{-50.0, 2.0}, {3.0, 2.0}}, 1.645).has_value());
  EXPECT_FALSE(Choose({{std::numeric_limits<double>::quiet_NaN(), 1.0}}, 1.645).has_value());
}

/// Two numbers with priors of one; the fitted data know the first to `known`, and nothing of the
/// second.
struct TwoNumbers {
  explicit TwoNumbers(double known) {
    Term term;
    term.effect = effect::Id::kCurrentGain;
    term.tolerance = 1.0;
    term.faulty_std = 1.0;
    terms.assign(2, term);
    problem.jtj = Eigen::Matrix2d::Zero();
    problem.jtj(0, 0) = 1.0 / (known * known);
    problem.jte = Eigen::Vector2d::Zero();
  }
  std::vector<Term> terms;
  LinearProblem problem;
};

/// Other data that want both numbers at `wanted`, known to `deviation`.
NormalEquations Wanting(double wanted, double deviation) {
  NormalEquations there;
  const double weight = 1.0 / (deviation * deviation);
  there.jtj = weight * Eigen::Matrix2d::Identity();
  there.jte = Eigen::Vector2d::Constant(-weight * wanted);
  return there;
}

TEST(Adapt, MovesWhatIsOpenAndHoldsWhatIsKnown) {
  const TwoNumbers numbers(0.01);
  const Evidence fitted(numbers.problem, numbers.terms, {});
  const auto adapted = fitted.Adapt(Wanting(1.0, 0.1), fitted.Unchanged());
  // Means of two measurements, weighted by their information (1 is the prior's).
  EXPECT_NEAR(adapted.change[0], 100.0 / (100.0 + 10'001.0), 1e-12);
  EXPECT_NEAR(adapted.change[1], 100.0 / 101.0, 1e-12);
  const double first = adapted.change[0];
  const double second = adapted.change[1];
  EXPECT_NEAR(adapted.penalty, 10'001.0 * first * first + second * second, 1e-9);
}

// The diagonal a thousand times as large: a thousandth of the step, in the same direction here.
TEST(Adapt, StepsShorterWithDamping) {
  const TwoNumbers numbers(0.01);
  const Evidence fitted(numbers.problem, numbers.terms, {});
  const auto whole = fitted.Adapt(Wanting(1.0, 0.1), fitted.Unchanged());
  const auto damped = fitted.Adapt(Wanting(1.0, 0.1), fitted.Unchanged(), 999.0);
  EXPECT_NEAR(damped.change[0], 1e-3 * whole.change[0], 1e-12);
  EXPECT_NEAR(damped.change[1], 1e-3 * whole.change[1], 1e-12);
  EXPECT_NEAR(damped.penalty, 1e-6 * whole.penalty, 1e-12);
}

TEST(Adapt, StaysWhereItIsOnceItHasArrived) {
  const TwoNumbers numbers(0.5);
  const Evidence fitted(numbers.problem, numbers.terms, {});
  const NormalEquations before = Wanting(1.0, 0.1);
  const auto once = fitted.Adapt(before, fitted.Unchanged());
  NormalEquations after = before;
  after.jte += before.jtj * once.change;
  const auto twice = fitted.Adapt(after, once);
  EXPECT_NEAR((twice.change - once.change).norm(), 0.0, 1e-12);
}

}  // namespace
}  // namespace levitas::diagnosis

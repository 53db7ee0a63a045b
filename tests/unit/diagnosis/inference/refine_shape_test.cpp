// Shapes between the members of a family, on evidence that is known at every one of them.

#include "diagnosis/inference/refine_shape.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <utility>
#include <vector>

namespace levitas::diagnosis {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;

/// One term of a family, whose shapes are powers of two from 1 on, and one that is of none.
class ToyMembers final : public MemberFits {
 public:
  explicit ToyMembers(std::size_t count = 1) : terms(2) {
    terms[0].family.shape = Family::Shape(count, 1.0);
    terms[0].family.log_width = Family::Shape(count, 1.0);
    terms[0].family.member = [](const Family::Shape&) { return Term{}; };
    cause.terms = {0, 1};
  }

  /// Doublings of each parameter; evidence of them, and the step that the slopes say.
  using Doublings = std::vector<double>;
  std::function<double(const Doublings&)> evidence = [](const Doublings&) { return 0.0; };
  std::function<double(std::size_t parameter, const Doublings&)> step =
      [](std::size_t, const Doublings&) { return 1.0; };
  bool refuses{};
  std::vector<Term> terms;
  Hypothesis cause;

  mutable std::vector<Doublings> tried;         ///< fits, in order
  mutable std::vector<std::size_t> parameters;  ///< stepped along, in order
  mutable std::vector<double> worths;           ///< of the fits
  mutable std::vector<Doublings> linearised;

  [[nodiscard]] Refined Start() const {
    Refined start;
    start.ok = true;
    start.point = {{0.0, 5.0}, {terms[0].family.shape, {}}};
    start.evidence = evidence(DoublingsAt(start.point));
    return start;
  }
  [[nodiscard]] Refined Refine(double worth = kAnyEvidence) const {
    return RefineShape(*this, cause, Start(), terms, worth);
  }
  [[nodiscard]] static Doublings DoublingsAt(const Point& point) {
    Doublings doublings;
    // Whole parts of 1e-9, so that rounding is no gain.
    for (const double value : point.shapes[0]) {
      doublings.push_back(std::round(std::log2(value) * 1e9) / 1e9);
    }
    return doublings;
  }

  [[nodiscard]] View LinearisedAt(const Point& at) const override {
    linearised.push_back(DoublingsAt(at));
    View view;
    view.point = at;
    return view;
  }
  /// All numbers go to 1 with the step.
  [[nodiscard]] Search::ShapeStep StepAlong(
      const Point& at, const View& about, double width,
      const std::function<Point(double)>& beside) const override {
    EXPECT_EQ(about.point, at);
    const Point moved = beside(width);
    std::size_t parameter = 0;
    while (moved.shapes[0][parameter] == at.shapes[0][parameter]) ++parameter;
    parameters.push_back(parameter);
    return {step(parameter, DoublingsAt(at)) * std::log(2.0),
            std::vector<double>(at.theta.size(), 1.0)};
  }
  [[nodiscard]] Refined Fit(Point start, const View&, double worth) const override {
    EXPECT_TRUE(start.shapes[1].empty()) << "the other term is of no family";
    tried.push_back(DoublingsAt(start));
    worths.push_back(worth);
    Refined fit;
    fit.ok = !refuses;
    fit.evidence = evidence(tried.back());
    fit.point = std::move(start);
    return fit;
  }
};

/// [nat] 50 less for the square of the doublings that the first parameter is from one doubling.
double BestAtOneDoubling(const ToyMembers::Doublings& at) {
  return -50.0 * std::pow(at[0] - 1.0, 2);
}

/// [nat] The same for both parameters.
double BestAtOneDoublingOfBoth(const ToyMembers::Doublings& at) {
  return BestAtOneDoubling(at) + BestAtOneDoubling({at[1]});
}

constexpr double kRounding = 1e-8;

TEST(RefineShape, MovesToTheBetterMemberWithAllNumbers) {
  ToyMembers toy;
  toy.evidence = BestAtOneDoubling;
  toy.step = [](std::size_t, const ToyMembers::Doublings& at) { return 1.0 - at[0]; };
  const Refined best = toy.Refine();
  EXPECT_NEAR(best.point.shapes[0][0], 2.0, kRounding);
  EXPECT_NEAR(best.evidence, 0.0, kRounding);
  EXPECT_THAT(best.point.theta, ElementsAre(1.0, 1.0));
  ASSERT_EQ(toy.linearised.size(), 2U) << "at the start and where it moved to";
  EXPECT_NEAR(toy.linearised[1][0], 1.0, kRounding);
}

TEST(RefineShape, ShortensAStepThatDoesNotGain) {
  // Ten times too far: 10, 3 and 0.9 doublings; from there 1, 0.3 and 0.09 more.
  ToyMembers toy;
  toy.evidence = BestAtOneDoubling;
  toy.step = [](std::size_t, const ToyMembers::Doublings& at) { return 10.0 * (1.0 - at[0]); };
  const Refined best = toy.Refine();
  ASSERT_EQ(toy.tried.size(), 6U);
  for (const auto& [at, doublings] : {std::pair{0U, 10.0}, std::pair{1U, 3.0}, std::pair{2U, 0.9},
                                      std::pair{3U, 1.9}, std::pair{4U, 1.2}, std::pair{5U, 0.99}})
    EXPECT_NEAR(toy.tried[at][0], doublings, kRounding) << at;
  EXPECT_NEAR(std::log2(best.point.shapes[0][0]), 0.99, kRounding);
  // The numbers go a share of the way to 1, too: 0.09 and then 0.09 of the rest.
  EXPECT_NEAR(best.point.theta[0], 1.0 - 0.91 * 0.91, kRounding);
  EXPECT_NEAR(best.point.theta[1], 1.0 + 4.0 * 0.91 * 0.91, kRounding);
}

TEST(RefineShape, KeepsTheStartWhereNothingGains) {
  ToyMembers toy;
  const Refined best = toy.Refine();
  EXPECT_EQ(best.point, toy.Start().point);
  EXPECT_EQ(toy.tried.size(), 3U) << "the whole step, 0.3 and 0.09 of it";
  EXPECT_EQ(toy.parameters.size(), 1U) << "no second round";
}

TEST(RefineShape, KeepsTheStartWhereNoFitFollows) {
  ToyMembers toy;
  toy.evidence = BestAtOneDoubling;
  toy.refuses = true;
  const Refined best = toy.Refine();
  EXPECT_EQ(best.point, toy.Start().point);
  EXPECT_EQ(best.evidence, -50.0);
}

TEST(RefineShape, AsksFitsForMoreThanItHas) {
  ToyMembers toy;
  toy.evidence = BestAtOneDoubling;
  (void)toy.Refine();
  ASSERT_GE(toy.worths.size(), 2U);
  EXPECT_EQ(toy.worths[0], -50.0);
  EXPECT_NEAR(toy.worths[1], 0.0, kRounding) << "after the first step, to the best";
}

TEST(RefineShape, EndsWithARoundThatGainsLessThanTenNat) {
  for (const auto& [nat, rounds] : {std::pair{9.0, 1U}, std::pair{11.0, 6U}}) {
    ToyMembers toy;
    toy.evidence = [nat = nat](const ToyMembers::Doublings& at) { return nat * at[0]; };
    const Refined best = toy.Refine();
    EXPECT_EQ(toy.parameters.size(), rounds) << nat << " nat for each; at most six";
    EXPECT_NEAR(std::log2(best.point.shapes[0][0]), rounds, kRounding);
  }
}

TEST(RefineShape, EndsWhereWorthIsOutOfReach) {
  // 20 nat for each of six rounds: 120 in all.
  for (const auto& [worth, rounds] : {std::pair{119.0, 6U}, std::pair{121.0, 1U}}) {
    ToyMembers toy;
    toy.evidence = [](const ToyMembers::Doublings& at) { return 20.0 * at[0]; };
    (void)toy.Refine(worth);
    EXPECT_EQ(toy.parameters.size(), rounds) << worth;
  }
}

TEST(RefineShape, TriesNoParameterAgainThatFailedUntilAnotherHasMoved) {
  ToyMembers toy(2);
  toy.evidence = BestAtOneDoublingOfBoth;
  toy.step = [](std::size_t parameter, const ToyMembers::Doublings& at) {
    return parameter == 0 ? 1.0 - at[0] : 0.0;
  };
  (void)toy.Refine();
  EXPECT_THAT(toy.parameters, ElementsAre(0, 1, 0)) << "the second one had failed right there";
  EXPECT_EQ(toy.linearised.size(), 2U) << "what failed leaves its linearisation to the next one";
}

TEST(RefineShape, TriesAParameterAgainOnceAnotherHasMoved) {
  ToyMembers toy(2);
  toy.evidence = BestAtOneDoublingOfBoth;
  // The slopes see the first one only beside the second.
  toy.step = [](std::size_t parameter, const ToyMembers::Doublings& at) {
    if (parameter == 0) return at[1] > 0.5 ? 1.0 - at[0] : 0.0;
    return 1.0 - at[1];
  };
  const Refined best = toy.Refine();
  // In the end the second one fails where the first has moved to, and so does the first.
  EXPECT_THAT(toy.parameters, ElementsAre(0, 1, 0, 1, 0));
  EXPECT_THAT(ToyMembers::DoublingsAt(best.point),
              ElementsAre(DoubleNear(1.0, kRounding), DoubleNear(1.0, kRounding)));
}

TEST(RefineShape, MovesEveryTermOfTheFamilyAlike) {
  ToyMembers toy;
  toy.evidence = BestAtOneDoubling;
  toy.terms.push_back(toy.terms[0]);
  toy.cause.terms.push_back(2);
  Refined start = toy.Start();
  start.point.theta.push_back(0.0);
  start.point.shapes.push_back({1.0});
  toy.step = [](std::size_t, const ToyMembers::Doublings& at) { return 1.0 - at[0]; };
  const Refined best = RefineShape(toy, toy.cause, start, toy.terms);
  EXPECT_NEAR(best.point.shapes[0][0], 2.0, kRounding);
  EXPECT_EQ(best.point.shapes[2], best.point.shapes[0]);
}

TEST(HasFamily, IsWhereAnyTermIsOfAFamily) {
  const ToyMembers toy;
  Hypothesis none;
  none.terms = {1};
  EXPECT_TRUE(HasFamily(toy.cause, toy.terms));
  EXPECT_FALSE(HasFamily(none, toy.terms));
}

}  // namespace
}  // namespace levitas::diagnosis

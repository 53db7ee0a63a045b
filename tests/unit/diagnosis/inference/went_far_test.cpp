// Whether calibration has moved a number surely beyond its tolerance.

#include <gtest/gtest.h>

#include <vector>

#include "diagnosis/inference/swallowed_causes.hpp"
#include "diagnosis/model/term.hpp"

namespace levitas::diagnosis {
namespace {

/// A nuisance of tolerance 0.03, at so many of them from the file, known to so many.
struct Calibrated {
  Calibrated(double tolerances, double known_to) : theta{0.03 * tolerances} {
    Term term;
    term.tolerance = 0.03;
    term.faulty_std = 0.15;
    terms = {term};
    // Behind its prior of one tolerance: 1/known^2 = information + 1.
    const double information = 1.0 / (known_to * known_to) - 1.0;
    problem.jtj = Eigen::MatrixXd::Constant(1, 1, information * 25.0);  // scale: 5 tolerances
    problem.jte = Eigen::VectorXd::Zero(1);
  }
  [[nodiscard]] bool Far(const std::vector<Hypothesis>& causes = {}) const {
    return WentFar(terms, problem, theta, causes, 3.0);
  }

  std::vector<Term> terms;
  LinearProblem problem;
  std::vector<double> theta;
};

TEST(WentFar, IsBeyondTheTolerancesByMoreThanTheDataLeaveOpen) {
  EXPECT_FALSE(Calibrated(2.9, 0.01).Far());
  EXPECT_TRUE(Calibrated(3.1, 0.01).Far());
  EXPECT_TRUE(Calibrated(-3.1, 0.01).Far());
  // 1.645 deviations of 0.1 are 0.16.
  EXPECT_FALSE(Calibrated(3.1, 0.1).Far());
  EXPECT_TRUE(Calibrated(3.2, 0.1).Far());
}

TEST(WentFar, IsCountedFromTheHealthyRig) {
  Calibrated numbers(6.0, 0.01);
  numbers.terms[0].healthy_mean = 0.03 * 4.0;
  EXPECT_FALSE(numbers.Far());
}

TEST(WentFar, IsNotWhatACauseMovesOrWhatIsNoNuisance) {
  Calibrated numbers(6.0, 0.01);
  Hypothesis moves;
  moves.terms = {0};
  moves.directions = Eigen::MatrixXd::Zero(1, 0);
  EXPECT_FALSE(numbers.Far({moves}));
  moves.terms = {1};
  EXPECT_TRUE(numbers.Far({moves}));
  numbers.terms[0].tolerance = 0.0;
  EXPECT_FALSE(numbers.Far());
}

// Shapes of modes are terms without an effect, as the one here is; the name changes nothing.
TEST(WentFar, IsAlsoANumberThatIsOfAnEffect) {
  Calibrated numbers(6.0, 0.01);
  EXPECT_TRUE(numbers.Far());
  numbers.terms[0].effect = effect::Id::kCurrentGain;
  EXPECT_TRUE(numbers.Far());
}

}  // namespace
}  // namespace levitas::diagnosis

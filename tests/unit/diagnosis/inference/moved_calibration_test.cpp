// Which calibrated numbers are too far from the file to be those of a healthy rig.

#include "diagnosis/inference/moved_calibration.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace levitas::diagnosis {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr double kTolerance = 0.03;

/// Numbers with a tolerance of 3 %, known to `deviation`.
struct Numbers {
  explicit Numbers(std::vector<double> at, double deviation = 0.002) : theta(std::move(at)) {
    Term term;
    term.effect = effect::Id::kCurrentGain;
    term.tolerance = kTolerance;
    term.faulty_std = 0.15;
    terms.assign(theta.size(), term);
    fit.deviation = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(theta.size()),
                                              deviation / term.scale());
  }

  [[nodiscard]] std::vector<std::size_t> Moved(const std::vector<Hypothesis>& causes = {}) const {
    return MovedBeyond(terms, fit, theta, causes, 3.0);
  }

  std::vector<double> theta;
  std::vector<Term> terms;
  Fit fit;
};

TEST(MovedCalibration, IsBeyondThreeTolerancesToEitherSideTheFurthestFirst) {
  EXPECT_THAT(Numbers({0.08, -0.12, 0.0, 0.15}).Moved(), ElementsAre(3, 1));
}

TEST(MovedCalibration, IsNotWhatTheDataDoNotKnow) {
  EXPECT_THAT(Numbers({-0.12}, 0.01).Moved(), ElementsAre(0));
  EXPECT_THAT(Numbers({-0.12}, 0.025).Moved(), IsEmpty());
}

TEST(MovedCalibration, IsCountedFromTheHealthyRig) {
  Numbers numbers({-0.12});
  numbers.terms[0].healthy_mean = -0.06;
  EXPECT_THAT(numbers.Moved(), IsEmpty());
}

TEST(MovedCalibration, IsNotWhatACauseMovesOrWhatHasNoEffect) {
  Numbers numbers({-0.12, -0.12, -0.12});
  numbers.terms[1].effect.reset();
  Hypothesis named;
  named.terms = {0};
  EXPECT_THAT(numbers.Moved({named}), ElementsAre(2));
}

}  // namespace
}  // namespace levitas::diagnosis

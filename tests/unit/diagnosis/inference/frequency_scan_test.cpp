// Calibration begins anew where a bending mode rings, on costs whose valleys are known.

#include "diagnosis/inference/frequency_scan.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace levitas::diagnosis {
namespace {

constexpr double kTolerance = 0.01;
constexpr std::size_t kFirst = 1, kDamping = 2, kSecond = 3;

Term OfMode(effect::Id id, std::size_t mode, double tolerance) {
  Term term;
  term.effect = id;
  term.location = AtMode(mode);
  term.tolerance = tolerance;
  return term;
}

/// A mode with a damping, another without, and a term that no mode has.
class FrequencyScanTest : public ::testing::Test {
 protected:
  FrequencyScanTest() {
    Term gain;
    gain.effect = effect::Id::kSensorGain;
    gain.tolerance = 0.03;
    terms_ = {gain, OfMode(effect::Id::kModalFrequency, 1, kTolerance),
              OfMode(effect::Id::kModalDamping, 1, 0.3),
              OfMode(effect::Id::kModalFrequency, 2, kTolerance)};
    start_.theta = {0.02, 0.0, 0.0, 0.0};
  }

  /// [nat] a valley of `depth` and a tolerance's width at a frequency of a mode, in tolerances.
  static double Valley(const Point& at, std::size_t mode, double tolerances, double depth) {
    return -depth * std::exp(-std::pow(at.theta[mode] / kTolerance - tolerances, 2));
  }

  [[nodiscard]] Point Scan(const std::function<double(const Point&)>& cost) {
    asked_ = 0;
    return AlongFrequencies(
        terms_,
        [&](const Point& at) {
          ++asked_;
          return cost(at);
        },
        start_);
  }

  std::vector<Term> terms_;
  Point start_;
  int asked_{};
};

TEST_F(FrequencyScanTest, FindsTheValleyThatDerivativesDoNotReach) {
  start_.theta[kDamping] = 0.6;
  const Point found = Scan([](const Point& at) { return Valley(at, kFirst, 3.5, 40.0); });
  EXPECT_NEAR(found.theta[kFirst], 3.5 * kTolerance, 1e-9);
}

TEST_F(FrequencyScanTest, LooksAboutTheHealthyRigsFrequency) {
  terms_[kFirst].healthy_mean = 0.05;
  start_.theta[kFirst] = 0.05;
  start_.theta[kDamping] = 0.6;
  const Point found = Scan([](const Point& at) { return Valley(at, kFirst, 8.0, 40.0); });
  EXPECT_NEAR(found.theta[kFirst], 8.0 * kTolerance, 1e-9);
}

TEST_F(FrequencyScanTest, GivesTheDampingBackWhereTheModeRings) {
  start_.theta[kDamping] = 0.9;
  const Point found = Scan([](const Point& at) {
    return Valley(at, kFirst, -2.25, 40.0) + 10.0 * std::abs(at.theta[kDamping]);
  });
  EXPECT_NEAR(found.theta[kFirst], -2.25 * kTolerance, 1e-9);
  EXPECT_EQ(found.theta[kDamping], 0.0);
}

// As a resonance is: with much damping broad and shallow, with little narrow and deep; between two
// places of the grid.
TEST_F(FrequencyScanTest, FindsANarrowValleyByWhatItIsWithTheDampingThatTheModeEndedWith) {
  start_.theta[kDamping] = 2.0;
  const Point found = Scan([](const Point& at) {
    const double width = 0.15 * (1.0 + 2.0 * std::abs(at.theta[kDamping]));
    const double off = at.theta[kFirst] / kTolerance - 2.3;
    return -60.0 * 0.15 / width / (1.0 + std::pow(off / width, 2));
  });
  EXPECT_NEAR(found.theta[kFirst], 2.25 * kTolerance, 1e-9);
  EXPECT_EQ(found.theta[kDamping], 0.0);
}

TEST_F(FrequencyScanTest, KeepsADampingThatIsThere) {
  start_.theta[kDamping] = 0.9;
  const auto damped = [](const Point& at) { return 100.0 * std::abs(at.theta[kDamping] - 0.9); };
  EXPECT_EQ(Scan(damped), start_);
  EXPECT_GT(asked_, 0);
}

TEST_F(FrequencyScanTest, LeavesModesAloneThatEndedAtTheFile) {
  start_.theta[kDamping] = 0.2;
  start_.theta[kFirst] = 1.5 * kTolerance;
  EXPECT_EQ(Scan([](const Point& at) { return Valley(at, kFirst, 3.5, 40.0); }), start_);
  EXPECT_EQ(asked_, 0);
}

// A spring at the shaft that calibration had put on mode shapes was lost to modes elsewhere.
TEST_F(FrequencyScanTest, LeavesModesAloneWhereAnotherNumberSaysThatACauseIsMissing) {
  start_.theta[kDamping] = 0.6;
  start_.theta[0] = -0.1;  // of a tolerance of 0.03
  EXPECT_EQ(Scan([](const Point& at) { return Valley(at, kFirst, 3.5, 40.0); }), start_);
  EXPECT_EQ(asked_, 0);
}

TEST_F(FrequencyScanTest, AFrequencyOffTheFileAsksWithoutADamping) {
  start_.theta[kSecond] = -2.5 * kTolerance;
  const Point found = Scan([](const Point& at) { return Valley(at, kSecond, 1.0, 40.0); });
  EXPECT_NEAR(found.theta[kSecond], kTolerance, 1e-9);
}

TEST_F(FrequencyScanTest, TheSecondModeBeginsWhereTheFirstWasFound) {
  start_.theta[kDamping] = 0.6;
  start_.theta[kSecond] = 3.0 * kTolerance;
  const Point found = Scan([](const Point& at) {
    const bool first_right = std::abs(at.theta[kFirst] - 2.0 * kTolerance) < 1e-9;
    return Valley(at, kFirst, 2.0, 40.0) + (first_right ? Valley(at, kSecond, -1.0, 20.0) : 0.0);
  });
  EXPECT_NEAR(found.theta[kFirst], 2.0 * kTolerance, 1e-9);
  EXPECT_NEAR(found.theta[kSecond], -kTolerance, 1e-9);
}

TEST_F(FrequencyScanTest, AValleyOfChanceIsNotTaken) {
  start_.theta[kDamping] = 0.6;
  EXPECT_EQ(Scan([](const Point& at) { return Valley(at, kFirst, 3.5, 2.0); }), start_);
}

TEST_F(FrequencyScanTest, AModelThatDivergesIsNoValley) {
  start_.theta[kDamping] = 0.6;
  const Point found = Scan([](const Point& at) {
    if (at.theta[kFirst] > 0.0) return std::numeric_limits<double>::quiet_NaN();
    return Valley(at, kFirst, -1.0, 40.0);
  });
  EXPECT_NEAR(found.theta[kFirst], -kTolerance, 1e-9);
}

TEST_F(FrequencyScanTest, WhatIsNotCalibratedIsNotScanned) {
  terms_[kFirst].tolerance = 0.0;
  start_.theta[kDamping] = 0.6;
  EXPECT_EQ(Scan([](const Point& at) { return Valley(at, kFirst, 3.5, 40.0); }), start_);
}

}  // namespace
}  // namespace levitas::diagnosis

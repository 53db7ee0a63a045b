// What a gain on validation data says of causes.

#include "diagnosis/inference/validation_doubt.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "diagnosis/inference/validation.hpp"
#include "tests/unit/diagnosis/toy_landscape.hpp"

namespace levitas::diagnosis {
namespace {

constexpr double kDeviations = 1.645;

TEST(DoubtOf, ConfirmsWhatGainsBeyondItsScatter) {
  EXPECT_EQ(DoubtOf(40.0, 20.0, kDeviations), Doubt::kNothing);
  EXPECT_EQ(DoubtOf(32.0, 20.0, kDeviations), Doubt::kUnconfirmed);
  EXPECT_EQ(DoubtOf(-32.0, 20.0, kDeviations), Doubt::kUnconfirmed);
  EXPECT_EQ(DoubtOf(-33.0, 20.0, kDeviations), Doubt::kValidationHarm);
}

// Forecasts that are 9 apart, squared, scatter by 6: less than what a right cause would need.
TEST(DoubtOf, IsNoneWhereTheDataCouldNotConfirmARightCause) {
  EXPECT_EQ(DoubtOf(9.0, 6.0, kDeviations), Doubt::kNothing);
  EXPECT_EQ(DoubtOf(20.0, 13.0, kDeviations), Doubt::kNothing);
  EXPECT_EQ(DoubtOf(20.0, 14.0, kDeviations), Doubt::kUnconfirmed);
  EXPECT_EQ(DoubtOf(0.0, 0.0, kDeviations), Doubt::kNothing);
  EXPECT_EQ(DoubtOf(-12.0, 6.0, kDeviations), Doubt::kValidationHarm);
}

TEST(DoubtOf, RefutesAModelThatDiverges) {
  EXPECT_EQ(DoubtOf(std::numeric_limits<double>::quiet_NaN(), 1.0, kDeviations),
            Doubt::kValidationHarm);
  EXPECT_EQ(DoubtOf(-std::numeric_limits<double>::infinity(), 1.0, kDeviations),
            Doubt::kValidationHarm);
}

TEST(ChanceOfGain, IsThatOfANormalDistribution) {
  EXPECT_NEAR(ChanceOfGain(0.0, 3.0), 0.5, 1e-12);
  EXPECT_NEAR(ChanceOfGain(1.6448536, 1.0), 0.95, 1e-6);
  EXPECT_NEAR(ChanceOfGain(-1.6448536, 1.0), 0.05, 1e-6);
  EXPECT_EQ(ChanceOfGain(std::numeric_limits<double>::quiet_NaN(), 1.0), 0.0);
}

// 20 nat of the fitted records against forty effects of a healthy rig: exp(20) / 40 : 1.
TEST(ChanceOfOpen, AddsWhatTheDataSayToWhatTheFittedRecordsSaid) {
  EXPECT_NEAR(ChanceOfOpen(20.0, 0.0, 40), 1.0 - 40.0 * std::exp(-20.0), 1e-9);
  EXPECT_NEAR(ChanceOfOpen(std::log(40.0) + 2.0, -2.0, 40), 0.5, 1e-12);
  EXPECT_LT(ChanceOfOpen(6.0, -5.0, 40), 0.1);
}

/// Of one cause, by its gain on validation data; found among four effects with 3 nat.
CauseSelection Doubted(const FitGain& worth) {
  ToyLandscape toy({10.0});
  CauseSelection found = toy.Found({toy.Add(role::kOnly, {1.0})});
  Judging judging;
  judging.gain_deviations = kDeviations;
  DoubtBy(worth, {3.0, 4}, judging, found);
  return found;
}

TEST(DoubtBy, SaysNothingOfCausesThatTheDataConfirm) {
  EXPECT_EQ(Doubted({40.0, 20.0}).doubt, Doubt::kNothing);
  EXPECT_EQ(Doubted({40.0, 20.0}).probability, 0.0);
}

TEST(DoubtBy, GivesRefutedCausesTheChanceOfTheirGain) {
  const CauseSelection found = Doubted({-40.0, 20.0});
  EXPECT_EQ(found.doubt, Doubt::kValidationHarm);
  EXPECT_NEAR(found.probability, 0.02275, 1e-5);  // two deviations
}

// Odds of e^(3 + 10 / 2) : 4.
TEST(DoubtBy, AddsHalfTheGainToTheFittedEvidenceOfCausesThatStayOpen) {
  const CauseSelection found = Doubted({10.0, 20.0});
  EXPECT_EQ(found.doubt, Doubt::kUnconfirmed);
  const double odds = std::exp(8.0) / 4.0;
  EXPECT_NEAR(found.probability, odds / (1.0 + odds), 1e-9);
}

TEST(DoubtBy, HasNothingToDoubtWithoutACause) {
  CauseSelection none;
  DoubtBy({-40.0, 20.0}, {}, Judging{}, none);
  EXPECT_EQ(none.doubt, Doubt::kNothing);
}

}  // namespace
}  // namespace levitas::diagnosis

// What a gain on validation data says of causes.

#include "diagnosis/inference/validation_doubt.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

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

}  // namespace
}  // namespace levitas::diagnosis

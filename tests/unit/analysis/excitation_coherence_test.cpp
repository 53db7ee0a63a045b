// How much of the innovations follows a test signal, where the share is known.

#include "analysis/records/excitation_coherence.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "common/random.hpp"

namespace levitas::analysis {
namespace {

constexpr std::array kEdgesHz{10.0, 1000.0, 5000.0};
constexpr std::size_t kRows = 60'000;  // 6 s: 117 averages of 1024 rows

/// Innovations of channel 0: `following` times the test signal of axis 1, and noise of 1 um.
InnovationRun Made(double following_m_per_a, double excitation_a) {
  Random random(21);
  InnovationRun run;
  run.period_s = 1e-4;
  std::vector<InnovationRow> rows(kRows);
  for (InnovationRow& row : rows) {
    row.excitation_a[1] = excitation_a * random.Normal();
    row.innovation_m[0] = following_m_per_a * row.excitation_a[1] + 1e-6 * random.Normal();
    row.innovation_m[1] = 1e-6 * random.Normal();
  }
  run.pieces.push_back(std::move(rows));
  return run;
}

TEST(FollowExcitation, UnrelatedInnovationsFollowAsMuchAsChance) {
  const auto bands = FollowExcitation(Made(0.0, 0.1), 0, 2, kEdgesHz);
  ASSERT_EQ(bands.size(), 2U);
  for (const ExcitationReport& band : bands) {
    EXPECT_NEAR(band.ratio, 1.0, 0.25) << band.low_hz;
    EXPECT_LT(std::abs(band.sigmas), 4.0) << band.low_hz;
  }
}

TEST(FollowExcitation, WhatFollowsStandsOutInEveryBandOfAWhiteSignal) {
  // Half of the power follows: coherence 1/2 against a chance of about 1/117.
  const auto bands = FollowExcitation(Made(1e-5, 0.1), 0, 2, kEdgesHz);
  ASSERT_EQ(bands.size(), 2U);
  for (const ExcitationReport& band : bands) {
    EXPECT_GT(band.ratio, 20.0) << band.low_hz;
    EXPECT_GT(band.sigmas, 30.0) << band.low_hz;
  }
}

TEST(FollowExcitation, AnotherChannelDoesNotFollow) {
  const auto bands = FollowExcitation(Made(1e-5, 0.1), 1, 2, kEdgesHz);
  ASSERT_EQ(bands.size(), 2U);
  for (const ExcitationReport& band : bands) EXPECT_LT(band.sigmas, 4.0) << band.low_hz;
}

TEST(FollowExcitation, DoesNotDependOnTheUnitOfTheSignal) {
  const auto one = FollowExcitation(Made(1e-5, 0.1), 0, 2, kEdgesHz);
  InnovationRun scaled = Made(1e-5, 0.1);
  for (InnovationRow& row : scaled.pieces[0]) row.excitation_a[1] *= 1000.0;
  const auto other = FollowExcitation(scaled, 0, 2, kEdgesHz);
  ASSERT_EQ(one.size(), other.size());
  // Both signals share one transform, in which um beside 100 A keep eight digits of sixteen.
  for (std::size_t k = 0; k < one.size(); ++k) {
    EXPECT_NEAR(other[k].ratio, one[k].ratio, 1e-6 * one[k].ratio);
  }
}

TEST(FollowExcitation, WithoutATestSignalNothingIsSaid) {
  EXPECT_TRUE(FollowExcitation(Made(0.0, 0.0), 0, 2, kEdgesHz).empty());
}

TEST(FollowExcitation, ARecordTooShortToTellFromChanceSaysNothing) {
  InnovationRun run = Made(1e-5, 0.1);
  run.pieces[0].resize(2048);
  EXPECT_TRUE(FollowExcitation(run, 0, 2, kEdgesHz).empty());
}

}  // namespace
}  // namespace levitas::analysis

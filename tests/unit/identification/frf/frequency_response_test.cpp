// The response that is estimated from a record in closed loop is that of the plant, its variance is
// that of the estimate, and neither depends on how axes are scaled, ordered or controlled.
#include "identification/frf/frequency_response.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "common/problem.hpp"
#include "common/random.hpp"
#include "common/rotational_speed.hpp"
#include "tests/unit/identification/frf/linear_loop.hpp"

namespace levitas::identification {
namespace {

using test::LinearLoop;
using testing::HasSubstr;

FrequencyResponse Estimate(const session::Recording& record, const ResponseOptions& options = {}) {
  const auto campaigns = GroupBySpeed(record, FindExperiments(record));
  EXPECT_EQ(campaigns.size(), 1U);
  return EstimateResponse(record, campaigns.front(), options);
}

/// Largest relative departure of the estimate from the plant of the closed form, over all lines.
double Departure(const FrequencyResponse& response) {
  double worst = 0.0;
  for (std::size_t k = 0; k < response.frequency_hz.size(); ++k) {
    const Eigen::Matrix2cd truth = LinearLoop::Plant(response.frequency_hz[k]);
    worst = std::max(worst, (response.plant[k] - truth).norm() / truth.norm());
  }
  return worst;
}

class InLoop : public testing::TestWithParam<double> {};

TEST_P(InLoop, PlantAndSensitivityAreThoseOfTheClosedForm) {
  const FrequencyResponse response = Estimate(LinearLoop::Run({.controller_a_per_m = GetParam()}));
  EXPECT_EQ(response.frequency_hz.size(), 254U);  // all lines below half the rate but the mean
  EXPECT_EQ(response.periods, 4U);                // the first of five is the transient
  // The transient is below 1e-11 by then; S is inverted with a condition of at most 100.
  EXPECT_LT(Departure(response), 1e-8);
  for (std::size_t k = 0; k < response.frequency_hz.size(); ++k) {
    const Eigen::Matrix2cd truth = LinearLoop::Sensitivity(response.frequency_hz[k], GetParam());
    EXPECT_LT((response.sensitivity[k] - truth).norm(), 1e-8) << response.frequency_hz[k];
    EXPECT_GT(response.coherence[k].minCoeff(), 1.0 - 1e-8);
    EXPECT_LE(response.coherence[k].maxCoeff(), 1.0 + 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(Controllers, InLoop, testing::Values(0.9e5, 1.0e5, 1.6e5));

/// Mean over the lines of |P - P_true|^2 in units of the variance that the estimate states.
Eigen::Matrix2d ErrorPerVariance(const FrequencyResponse& response) {
  Eigen::Matrix2d ratio = Eigen::Matrix2d::Zero();
  const auto lines = static_cast<double>(response.frequency_hz.size());
  for (std::size_t k = 0; k < response.frequency_hz.size(); ++k) {
    const Eigen::Matrix2d square =
        (response.plant[k] - LinearLoop::Plant(response.frequency_hz[k])).cwiseAbs2();
    ratio += square.cwiseQuotient(response.variance[k]) / lines;
  }
  return ratio;
}

TEST(FrequencyResponse, ErrorsUnderNoiseAreOfTheVarianceThatItStates) {
  const Eigen::Matrix2d ratio =
      ErrorPerVariance(Estimate(LinearLoop::Run({.periods = 9, .noise_m = 3e-9, .seed = 11})));
  // 254 complex errors per entry: 508 degrees of freedom, 6 % of one sigma; the variances, means of
  // 21 lines and 7 free periods, add 5 %. The band is four sigma of both.
  EXPECT_GT(ratio.minCoeff(), 0.69) << ratio;
  EXPECT_LT(ratio.maxCoeff(), 1.31) << ratio;
}

TEST(FrequencyResponse, ErrorsAreOfTheVarianceThoughTheSignalExcitesItsLinesUnevenly) {
  const Eigen::Matrix2d ratio = ErrorPerVariance(
      Estimate(LinearLoop::Run({.periods = 9, .noise_m = 3e-10, .flat = false, .seed = 11})));
  // As above: four sigma.
  EXPECT_GT(ratio.minCoeff(), 0.69) << ratio;
  EXPECT_LT(ratio.maxCoeff(), 1.31) << ratio;
}

TEST(FrequencyResponse, TheVarianceOfASensitivityFollowsAPeakNarrowerThanTheNeighbours) {
  constexpr double kControllerAPerM = 0.9e5;
  constexpr double kNearTop = 0.8;  // some ten lines, in a mean over 21
  double squares = 0.0;
  double stated = 0.0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const FrequencyResponse r = Estimate(LinearLoop::Run(
        {.periods = 9, .controller_a_per_m = kControllerAPerM, .noise_m = 3e-9, .seed = seed}));
    std::vector<std::complex<double>> truth;
    for (const double f : r.frequency_hz) {
      truth.push_back(LinearLoop::Sensitivity(f, kControllerAPerM)(0, 0));
    }
    const double top = std::abs(std::ranges::max(truth, {}, [](auto s) { return std::abs(s); }));
    for (std::size_t k = 0; k < truth.size(); ++k) {
      if (std::abs(truth[k]) < kNearTop * top) continue;
      squares += std::norm(r.sensitivity[k](0, 0) - truth[k]);
      stated += r.own_variance[k][0];
    }
  }
  // 400 complex errors: 5 % of one sigma. The flat mean over the neighbours states a quarter less.
  EXPECT_NEAR(squares / stated, 1.0, 0.15);
}

TEST(FrequencyResponse, FourTimesAsManyPeriodsQuarterTheVariance) {
  const FrequencyResponse few = Estimate(LinearLoop::Run({.periods = 5, .noise_m = 3e-9}));
  const FrequencyResponse many = Estimate(LinearLoop::Run({.periods = 17, .noise_m = 3e-9}));
  double ratio = 0.0;
  for (std::size_t k = 0; k < few.variance.size(); ++k) {
    ratio +=
        many.variance[k].sum() / few.variance[k].sum() / static_cast<double>(few.variance.size());
  }
  // 254 lines of 3 free periods: 1500 degrees of freedom, 3.6 % of one sigma; a mean of ratios of
  // smoothed lines is larger than the ratio by their variance, 0.8 %.
  EXPECT_NEAR(ratio, 0.25, 0.04);
}

TEST(FrequencyResponse, ASensorThatReadsThreefoldMultipliesItsRowAndNoOther) {
  session::Recording record = LinearLoop::Run({.noise_m = 1e-9});
  const FrequencyResponse before = Estimate(record);
  for (double& value : record.position_m[0]) value *= 3.0;
  const FrequencyResponse after = Estimate(record);
  const Eigen::DiagonalMatrix<double, 2> gain(3.0, 1.0);
  const Eigen::DiagonalMatrix<double, 2> square(9.0, 1.0);
  for (std::size_t k = 0; k < before.plant.size(); ++k) {
    // Rounding of the transforms alone.
    const Eigen::MatrixXcd plant = gain * before.plant[k];
    EXPECT_LT((after.plant[k] - plant).norm(), 1e-10 * plant.norm());
    const Eigen::MatrixXd variance = square * before.variance[k];
    EXPECT_LT((after.variance[k] - variance).norm(), 1e-8 * variance.norm());
    EXPECT_LT((after.sensitivity[k] - before.sensitivity[k]).norm(), 1e-12);
  }
}

TEST(FrequencyResponse, ChannelsInAnotherOrderPermuteRowsAndColumns) {
  session::Recording record = LinearLoop::Run({.noise_m = 1e-9});
  const FrequencyResponse before = Estimate(record);
  std::swap(record.channels[0], record.channels[1]);
  for (auto* columns : {&record.position_m, &record.current_a, &record.excitation_a}) {
    std::swap((*columns)[0], (*columns)[1]);
  }
  const FrequencyResponse after = Estimate(record);
  for (std::size_t k = 0; k < before.plant.size(); ++k) {
    EXPECT_LT((after.plant[k] - before.plant[k].reverse()).norm(), 1e-10 * before.plant[k].norm());
    EXPECT_LT((after.coherence[k] - before.coherence[k].reverse()).norm(), 1e-12);
    EXPECT_LT((after.variance[k] - before.variance[k].reverse()).norm(),
              1e-8 * before.variance[k].norm());
  }
}

TEST(FrequencyResponse, OneAxisExcitedTwiceHasTheMeanOfBothAndHalfTheVariance) {
  const session::Recording once = LinearLoop::Run({.periods = 6, .noise_m = 3e-9});
  auto campaign = GroupBySpeed(once, FindExperiments(once)).front();
  const FrequencyResponse single = EstimateResponse(once, campaign);
  campaign.experiments.push_back(campaign.experiments[0]);
  const FrequencyResponse twice = EstimateResponse(once, campaign);
  for (std::size_t k = 0; k < single.plant.size(); ++k) {
    EXPECT_LT((twice.plant[k] - single.plant[k]).norm(), 1e-12 * single.plant[k].norm());
    // The sum of two equal powers over the square of their count; rounding alone departs.
    EXPECT_LT((2.0 * twice.noise[k].col(0) - single.noise[k].col(0)).norm(),
              1e-9 * single.noise[k].col(0).norm());
    EXPECT_LT((twice.noise[k].col(1) - single.noise[k].col(1)).norm(),
              1e-9 * single.noise[k].col(1).norm());
  }
}

TEST(FrequencyResponse, CoherenceCountsEveryExperimentOfAnAxisInWhateverOrder) {
  session::Recording record = LinearLoop::Run({.periods = 10, .noise_m = 1e-9});
  auto campaign = GroupBySpeed(record, FindExperiments(record)).front();
  for (auto& experiment : campaign.experiments) experiment.periods = 4;
  auto second = campaign.experiments[0];
  second.begin += 4 * second.period_samples;
  const FrequencyResponse quiet = EstimateResponse(record, campaign);
  // Only the second experiment is disturbed, by a reading that does not repeat.
  Random random(11);
  for (std::size_t row = second.begin; row < second.end(); ++row) {
    record.position_m[0][row] += 2e-6 * random.Normal();
  }
  campaign.experiments.push_back(second);
  const FrequencyResponse after = EstimateResponse(record, campaign);
  std::swap(campaign.experiments.front(), campaign.experiments.back());
  const FrequencyResponse before = EstimateResponse(record, campaign);
  double lost = 0.0;
  for (std::size_t k = 0; k < quiet.plant.size(); ++k) {
    EXPECT_LT((after.coherence[k] - before.coherence[k]).norm(), 1e-12);
    EXPECT_EQ(after.coherence[k].col(1), quiet.coherence[k].col(1));
    lost = std::max(lost, quiet.coherence[k](0, 0) - after.coherence[k](0, 0));
  }
  EXPECT_GT(lost, 0.1);  // the harm that the order of experiments hid
}

TEST(FrequencyResponse, RunOutDoesNotReachTheLinesBesideItsOrders) {
  constexpr double kTurnHz = 137.0;
  const session::Recording record = LinearLoop::Run(
      {.periods = 9, .run_out_m = 5e-6, .speed_rad_per_s = 2.0 * std::numbers::pi * kTurnHz});
  const FrequencyResponse kept = Estimate(record, {.orders = 0});
  const FrequencyResponse removed = Estimate(record, {.orders = 5});
  EXPECT_GT(Departure(kept), 0.2);  // the harm: lines beside 137 Hz carry the run-out
  // The order takes along what the test signal has within 1/T of it: T is 8 periods, so a line
  // beside loses at most a part in 8 of its neighbours' difference.
  EXPECT_LT(Departure(removed), 0.05);
  // Lines are 1/(510 x 0.1 ms) = 19.6 Hz apart; those within 0.75 of it are left out.
  ASSERT_FALSE(removed.left_out_hz.empty());
  for (const double f : removed.left_out_hz) {
    EXPECT_LT(std::abs(std::remainder(f, kTurnHz)), 0.75 * 19.61) << f;
    EXPECT_LT(f, 5.0 * kTurnHz + 0.75 * 19.61);
  }
  EXPECT_EQ(removed.frequency_hz.size() + removed.left_out_hz.size(), 254U);
}

TEST(FrequencyResponse, LinesBeyondTheHighestFrequencyAreLeftOut) {
  const FrequencyResponse response = Estimate(LinearLoop::Run({}), {.highest_hz = 1000.0});
  // 1000 Hz over 19.6 Hz is 51.0: the line at 51 x 19.608 = 1000.0 Hz rounds to the limit.
  EXPECT_NEAR(static_cast<double>(response.frequency_hz.size()), 51.0, 1.0);
  EXPECT_LE(response.frequency_hz.back(), 1000.0);
}

TEST(FrequencyResponse, LinesThatTheSignalDoesNotExciteAreLeftOut) {
  // A square wave of 51 samples a half period has odd harmonics only.
  session::Recording record = LinearLoop::Empty(2 * 5 * 102, 0.0);
  Random random(5);
  for (std::size_t row = 0; row < record.rows(); ++row) {
    const std::size_t axis = row / (5 * 102);
    record.excitation_a[axis][row] = row % 102 < 51 ? 0.1 : -0.1;
    record.current_a[axis][row] = record.excitation_a[axis][row];
    for (std::size_t i = 0; i < 2; ++i) record.position_m[i][row] = 1e-6 * random.Normal();
  }
  const FrequencyResponse response = Estimate(record);
  ASSERT_EQ(response.frequency_hz.size(), 25U);  // 1, 3 .. 49 of the 50 below half the rate
  for (const double f : response.frequency_hz) {
    EXPECT_EQ(std::lround(f * 102e-4) % 2, 1) << f;
  }
}

TEST(FrequencyResponse, MomentsAndExtremesAreThoseOfTheRecord) {
  // Position and current of both axes are sines of known amplitude about a mean; the test signal is
  // +-0.1 A.
  session::Recording record = LinearLoop::Run({.flat = false});
  for (std::size_t row = 0; row < record.rows(); ++row) {
    const double phase = 2.0 * std::numbers::pi * static_cast<double>(row % 510) / 510.0;
    record.position_m[0][row] = 4e-6 + 3e-6 * std::cos(phase);
    record.position_m[1][row] = -9e-6 + 3e-6 * std::sin(phase);
    for (std::size_t i = 0; i < 2; ++i) {
      record.current_a[i][row] = 0.25 + 0.5 * std::cos(phase) + record.excitation_a[i][row];
    }
  }
  const FrequencyResponse response = Estimate(record);
  const Moments& m = response.moments;
  // Whole periods: means of squares of a sine are half the square of its amplitude, to rounding.
  EXPECT_NEAR(m.position_square_m2(0, 1), 0.5 * 9e-12, 1e-20);
  EXPECT_NEAR(m.position_square_m2(1, 0), 0.5 * 9e-12, 1e-20);
  EXPECT_NEAR(m.current_square_a2(0, 1), 0.125, 1e-9);
  EXPECT_NEAR(m.product_a_m(0, 1), 0.5 * 0.5 * 3e-6, 1e-14);
  EXPECT_NEAR(m.product_a_m(1, 0), 0.0, 1e-14);         // a quarter period apart
  EXPECT_NEAR(response.largest_orbit_m, 3e-6, 1e-14);   // a circle about the means
  EXPECT_NEAR(response.largest_current_a, 0.85, 1e-9);  // mean, sine and test signal at once
}

TEST(FrequencyResponse, AnAmplifierLessensTheMomentsOfTheCurrentAsAFirstOrderLag) {
  const session::Recording record = LinearLoop::Run({.periods = 9});
  const FrequencyResponse slow = Estimate(record, {.amplifier_hz = 400.0});
  const FrequencyResponse fast = Estimate(record, {});
  // The excited axis carries nearly white current; a lag of pole a passes (1 - a)/(1 + a) of white
  // noise. The controller's part is slow and not white: a third of the share is its place.
  const double pole = std::exp(-2.0 * std::numbers::pi * 400.0 * 1e-4);
  const double share = slow.moments.current_square_a2(0, 0) / fast.moments.current_square_a2(0, 0);
  EXPECT_GT(share, (1.0 - pole) / (1.0 + pole) / 1.5);
  EXPECT_LT(share, 1.0);
  EXPECT_EQ(slow.moments.position_square_m2, fast.moments.position_square_m2);
}

}  // namespace
}  // namespace levitas::identification

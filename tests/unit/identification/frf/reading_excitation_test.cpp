// Test signals that are added to the reading instead of the current.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>

#include "common/problem.hpp"
#include "identification/frf/frequency_response.hpp"
#include "tests/unit/identification/frf/linear_loop.hpp"

namespace levitas::identification {
namespace {

using test::LinearLoop;
using test::LoopPlan;
using testing::HasSubstr;

std::string ReadingRefusal(const session::Recording& record) {
  try {
    (void)EstimateResponses(record, LinearLoop::kPeriodS);
  } catch (const BadInput& problem) {
    return problem.what();
  }
  return {};
}

FrequencyResponse ReadingResponse(const session::Recording& record) {
  const auto experiments = FindExperiments(record);
  return EstimateResponse(record, GroupBySpeed(record, experiments).front());
}

TEST(ReadingExcitation, GivesThePlantAndTheSensitivityThatTheClosedFormHas) {
  LoopPlan plan;
  plan.point = SummingPoint::kReading;
  const FrequencyResponse response = ReadingResponse(LinearLoop::Run(plan));
  ASSERT_EQ(response.frequency_hz.size(), plan.period_samples / 2 - 1);
  EXPECT_EQ(response.point, SummingPoint::kReading);
  for (std::size_t k = 0; k < response.frequency_hz.size(); ++k) {
    const double f = response.frequency_hz[k];
    const Eigen::Matrix2cd plant = LinearLoop::Plant(f);
    const Eigen::Matrix2cd s = LinearLoop::Sensitivity(f, plan.controller_a_per_m);
    // The transient is below rounding after one period: 0.93^510.
    EXPECT_LT((response.plant[k] - plant).norm(), 1e-8 * plant.norm()) << f;
    EXPECT_LT((response.sensitivity[k] - s).norm(), 1e-8) << f;
    EXPECT_LT((response.currents[k] + plan.controller_a_per_m * s).norm(),
              1e-8 * plan.controller_a_per_m)
        << f;
  }
}

TEST(ReadingExcitation, IsNotTakenForOneOfTheCurrent) {
  LoopPlan plan;
  plan.point = SummingPoint::kReading;
  session::Recording record = LinearLoop::Run(plan);
  std::swap(record.excitation_a, record.excitation_m);
  const FrequencyResponse taken = ReadingResponse(record);
  const double f = taken.frequency_hz[20];
  const Eigen::Matrix2cd s = LinearLoop::Sensitivity(f, plan.controller_a_per_m);
  EXPECT_GT((taken.sensitivity[20] - s).norm(), 1.0);
}

TEST(ReadingExcitation, HasTheVarianceOfTheReadingsScatter) {
  LoopPlan plan;
  plan.point = SummingPoint::kReading;
  plan.noise_m = 1e-8;
  plan.periods = 41;
  const FrequencyResponse response = ReadingResponse(LinearLoop::Run(plan));
  double squares = 0.0;
  double expected = 0.0;
  for (std::size_t k = 0; k < response.frequency_hz.size(); ++k) {
    const Eigen::Matrix2cd s =
        LinearLoop::Sensitivity(response.frequency_hz[k], plan.controller_a_per_m);
    squares += std::norm(response.sensitivity[k](0, 0) - s(0, 0));
    expected += response.own_variance[k][0];
  }
  // 254 complex errors: their mean square is within 4/sqrt(254) of its expectation.
  EXPECT_NEAR(squares / expected, 1.0, 0.25);
}

TEST(Experiments, LeaveOutAPeriodThatTheSignalBreaksOffIn) {
  LoopPlan plan;
  plan.periods = 6;
  session::Recording record = LinearLoop::Run(plan);
  const std::size_t rows_per_axis = plan.periods * plan.period_samples;
  const auto whole = FindExperiments(record);
  ASSERT_EQ(whole.size(), 2U);
  EXPECT_EQ(whole[0].periods, 5U);  // the first is the transient
  // Half of the last period of the first axis is silent, and nothing else begins in it.
  auto& signal = record.excitation_a[0];
  std::fill(signal.begin() + static_cast<std::ptrdiff_t>(rows_per_axis - plan.period_samples / 2),
            signal.end(), 0.0);
  EXPECT_EQ(FindExperiments(record)[0].periods, 4U);
}

TEST(ReadingExcitation, OnOneAxisAndOfTheCurrentOnTheOtherIsRefused) {
  const session::Recording current = LinearLoop::Run({});
  LoopPlan plan;
  plan.point = SummingPoint::kReading;
  session::Recording mixed = LinearLoop::Run(plan);
  mixed.excitation_a[1] = current.excitation_a[1];
  mixed.excitation_m[1].clear();
  EXPECT_THAT(ReadingRefusal(mixed), HasSubstr("use one point for all axes"));
  EXPECT_EQ(ReadingRefusal(current), "");
}

TEST(ReadingExcitation, TogetherWithOneOfTheCurrentIsRefused) {
  LoopPlan plan;
  plan.point = SummingPoint::kReading;
  session::Recording record = LinearLoop::Run(plan);
  EXPECT_EQ(ReadingRefusal(record), "");
  record.excitation_a = record.excitation_m;
  EXPECT_THAT(ReadingRefusal(record), HasSubstr("its current and its reading together"));
}

}  // namespace
}  // namespace levitas::identification

#include "verdict/measure_sensitivity.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "session/exchange/recording.hpp"
#include "tests/unit/identification/frf/linear_loop.hpp"

namespace levitas::verdict {
namespace {

using session::Recording;
using test::LinearLoop;
using test::LoopPlan;
using testing::HasSubstr;
using testing::SizeIs;

template <class T>
void Prepend(std::vector<T>& column, std::size_t rows, const T& value) {
  column.insert(column.begin(), rows, value);
}

/// The record behind `rows` of a rotor that is levitated and not excited.
Recording AfterQuiet(Recording r, std::size_t rows) {
  for (std::uint64_t& cycle : r.cycle) cycle += rows;
  for (std::size_t row = rows; row-- > 0;) Prepend<std::uint64_t>(r.cycle, 1, row);
  for (auto* column : {&r.levitated, &r.amplifiers_enabled})
    Prepend<std::uint8_t>(*column, rows, 1);
  for (auto* column : {&r.speed_rad_per_s, &r.angle_rad}) Prepend(*column, rows, 0.0);
  Prepend(r.bias_current_a, rows, 1.0);
  for (auto* columns : {&r.position_m, &r.current_a, &r.excitation_a, &r.excitation_m}) {
    for (auto& column : *columns) Prepend(column, rows, 0.0);
  }
  return r;
}

/// The rows of a record that the verdict keeps: the first, and all from the first test signal on.
Recording Kept(const Recording& r, std::size_t quiet_rows) {
  Recording kept = AfterQuiet(r, 1);
  for (std::size_t row = 1; row < kept.rows(); ++row) kept.cycle[row] += quiet_rows - 1;
  return kept;
}

const std::vector<analysis::SensitivityResult>& ComputedAtRest() {
  static const std::vector<analysis::SensitivityResult> known(1);  // at 0 rad/s, of no axis
  return known;
}

MeasuredSensitivity Measured(const Recording& record) {
  return MeasureSensitivity(record, {}, {}, ComputedAtRest());
}

TEST(MeasureSensitivity, FindsThePeakOfTheLoopThatRan) {
  const LoopPlan plan;
  const MeasuredSensitivity measured = Measured(LinearLoop::Run(plan));
  EXPECT_EQ(measured.why_not, "");
  ASSERT_THAT(measured.speeds, SizeIs(1));
  ASSERT_THAT(measured.speeds[0].axes, SizeIs(2));
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const MeasuredAxis& at = measured.speeds[0].axes[axis];
    const auto i = static_cast<Eigen::Index>(axis);
    const double line =
        std::abs(LinearLoop::Sensitivity(at.frequency_hz, plan.controller_a_per_m)(i, i));
    EXPECT_NEAR(at.line_peak, line, 0.02 * line) << axis;
  }
}

// Rows before the first test signal are not kept, but time counts from the first row of the record.
TEST(MeasureSensitivity, IsTheSameWithoutTheRowsBeforeTheFirstTestSignal) {
  constexpr std::size_t kQuiet = 3000;
  const Recording loop = LinearLoop::Run({.noise_m = 1e-7, .seed = 7});
  const MeasuredSensitivity whole = Measured(AfterQuiet(loop, kQuiet));
  const MeasuredSensitivity kept = Measured(Kept(loop, kQuiet));
  ASSERT_THAT(whole.speeds, SizeIs(1));
  ASSERT_THAT(kept.speeds, SizeIs(1));
  for (std::size_t axis = 0; axis < 2; ++axis) {
    EXPECT_EQ(whole.speeds[0].axes[axis].peak, kept.speeds[0].axes[axis].peak);
    EXPECT_EQ(whole.speeds[0].axes[axis].sigma, kept.speeds[0].axes[axis].sigma);
  }
}

TEST(MeasureSensitivity, SaysWhatTheRecordLacksWithTheTimeOfTheRecord) {
  constexpr std::size_t kQuiet = 3000;
  Recording loop = LinearLoop::Run({});
  loop.excitation_a[1] = loop.excitation_a[0];
  const MeasuredSensitivity kept = Measured(Kept(loop, kQuiet));
  EXPECT_THAT(kept.speeds, SizeIs(0));
  EXPECT_THAT(kept.why_not, HasSubstr("excites x and y together"));
  EXPECT_THAT(kept.why_not, HasSubstr("from 0.3000 s"));
  EXPECT_EQ(kept.why_not, Measured(AfterQuiet(loop, kQuiet)).why_not);
}

}  // namespace
}  // namespace levitas::verdict

// Rows made in memory, so that nothing but their meaning is tested; files are in csv_test.cpp.

#include "session/exchange/measured_data.hpp"

#include <gtest/gtest.h>

#include "common/problem.hpp"

namespace levitas::session {
namespace {

constexpr double kRowPeriodS = 1e-4;

/// The columns are said by their quantities, all of axis 0.
class MadeRows : public RowSource {
 public:
  MadeRows(const std::vector<CsvQuantity>& quantities, std::vector<CsvRow> rows)
      : rows_(std::move(rows)) {
    for (const CsvQuantity quantity : quantities) {
      CsvColumn column;
      column.quantity = quantity;
      layout_.columns.push_back(column);
    }
  }
  [[nodiscard]] const CsvLayout& layout() const noexcept override { return layout_; }
  bool Next(CsvRow& row) override {
    if (given_ == rows_.size()) return false;
    row = rows_[given_++];
    return true;
  }
  [[nodiscard]] BadInput Bad(const std::string& what) const override { return BadInput(what); }

 private:
  CsvLayout layout_;
  std::vector<CsvRow> rows_;
  std::size_t given_{};
};

RigNumbers MeasuredRig(std::size_t axes) {
  RigNumbers rig;
  rig.channels.assign(axes, "x");
  rig.bearings = {"only"};
  rig.bias_current_a = 1.0;
  rig.max_coil_current_a = 8.0;
  rig.clearance_m = rig.sensor_range_m = 1e-3;
  return rig;
}

struct Taken {
  ImportReport report;
  std::vector<cycle::CycleRecord> records;
};

Taken TakeAll(MadeRows rows, std::size_t axes = 1) {
  const RigNumbers rig = MeasuredRig(axes);
  const std::vector<CoilScale> coils(axes, CoilScale{.gap_m = 0.4e-3, .full_current_a = 8.0});
  Taken taken;
  taken.report = ReadRecords(rows, {.rig = rig, .coils = coils},
                             [&](const cycle::CycleRecord& r) { taken.records.push_back(r); });
  return taken;
}

/// Rows that hold their times alone.
MadeRows AtPeriods(std::initializer_list<double> periods) {
  std::vector<CsvRow> rows;
  for (const double period : periods) rows.push_back({.time_s = period * kRowPeriodS});
  return {{CsvQuantity::kTime}, rows};
}

TEST(MeasuredData, OfGapAndDutiesArePositionControlCurrentAndBias) {
  CsvRow row;
  row.gap_m[0] = 0.3e-3;
  row.duty_towards[0] = 0.75;
  row.duty_away[0] = 0.25;
  const std::vector<CsvQuantity> columns{CsvQuantity::kTime, CsvQuantity::kGap,
                                         CsvQuantity::kDutyTowards, CsvQuantity::kDutyAway};
  const Taken taken = TakeAll({columns, {row}});
  ASSERT_EQ(taken.records.size(), 1U);
  // The rotor is 0.1 mm nearer to the coil towards + than the centre; 6 A and 2 A were commanded.
  EXPECT_NEAR(taken.records[0].in.frame.position_m[0], 0.1e-3, 1e-18) << "rounding of 0.4 - 0.3";
  EXPECT_EQ(taken.records[0].out.current.control_current_a[0], 2.0);
  EXPECT_EQ(taken.records[0].out.current.bias_current_a, 4.0);
  EXPECT_THROW(TakeAll({columns, {row}}, 2), BadInput) << "whose duty is it?";
}

TEST(MeasuredData, CountALongerStepOfTimeAsMissingCycles) {
  const Taken taken = TakeAll(AtPeriods({0.0, 1.0, 4.2, 5.0}));
  ASSERT_EQ(taken.records.size(), 4U);
  EXPECT_EQ(taken.records[1].in.cycle, 1U);
  EXPECT_EQ(taken.records[2].in.cycle, 4U) << "a fifth of a period off is still the fourth";
  EXPECT_EQ(taken.records[3].in.cycle, 5U);
  EXPECT_EQ(taken.report.rows, 4U);
  EXPECT_EQ(taken.report.drop_outs, 1U);
  EXPECT_EQ(taken.report.missing_cycles, 2U);
  EXPECT_DOUBLE_EQ(taken.report.duration_s, 5.0 * kRowPeriodS);
}

TEST(MeasuredData, RefuseAStepThatIsNoWholeNumberOfPeriodsOrLongerThanTheLongestGap) {
  EXPECT_THROW(TakeAll(AtPeriods({0.0, 1.4})), BadInput);
  EXPECT_THROW(TakeAll(AtPeriods({0.0, 0.0})), BadInput);
  EXPECT_THROW(TakeAll(AtPeriods({1.0, 0.0})), BadInput);
  const double longest = kLongestGapS / kRowPeriodS;
  EXPECT_EQ(TakeAll(AtPeriods({0.0, longest})).report.missing_cycles, 599'999U);
  EXPECT_THROW(TakeAll(AtPeriods({0.0, longest + 1.0})), BadInput);
  EXPECT_THROW(TakeAll(AtPeriods({})), BadInput) << "no rows";
}

// 100 rad/s, of which the file has the angle alone or the speed alone.
TEST(MeasuredData, CompleteTheRotationFromWhatOfItTheFileHas) {
  std::vector<CsvRow> rows(3);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].time_s = static_cast<double>(i) * kRowPeriodS;
    rows[i].angle_rad = 100.0 * rows[i].time_s;
  }
  const Taken of_angle = TakeAll({{CsvQuantity::kTime, CsvQuantity::kAngle}, rows});
  ASSERT_EQ(of_angle.records.size(), 3U);
  for (const auto& record : of_angle.records) {  // the first too, which has no slope by itself
    EXPECT_NEAR(record.in.frame.speed_rad_per_s, 100.0, 1e-9) << "rounding of 0.01 rad";
    EXPECT_EQ(record.out.mode, Mode::kSpinning);
  }
  for (CsvRow& row : rows) {
    row.angle_rad = 0.0;
    row.speed_rad_per_s = 100.0;
  }
  const Taken of_speed = TakeAll({{CsvQuantity::kTime, CsvQuantity::kSpeed}, rows});
  ASSERT_EQ(of_speed.records.size(), 3U);
  EXPECT_DOUBLE_EQ(of_speed.records[2].in.frame.angle_rad, 0.02);
  EXPECT_EQ(TakeAll(AtPeriods({0.0, 1.0})).records[0].out.mode, Mode::kLevitating);
}

}  // namespace
}  // namespace levitas::session

#include "session/exchange/measured_data.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <numbers>
#include <optional>

#include "common/problem.hpp"

namespace levitas::session {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

double WrapAngle(double angle_rad) {
  if (angle_rad >= 0.0 && angle_rad < kTurn) return angle_rad;
  const double wrapped = std::fmod(angle_rad, kTurn);
  if (wrapped >= 0.0) return wrapped;
  // A tiny negative angle plus a turn rounds to the whole turn, which is zero again.
  const double lifted = wrapped + kTurn;
  return lifted < kTurn ? lifted : 0.0;
}

/// Speed from the slope of the angle, whether the file counts turns or wraps them.
class SlopeOfAngle {
 public:
  double Step(double time_s, double angle_rad) {
    if (!points_.empty()) {
      const Point& last = points_.back();
      // In a long drop-out the rotor may turn several times: the last speed tells how often.
      const double expected = speed_ * (time_s - last.time_s);
      const double turned = angle_rad - last_angle_rad_;
      const double unwrapped =
          last.unwrapped_rad + expected + std::remainder(turned - expected, kTurn);
      points_.push_back({time_s, unwrapped});
      if (points_.size() > kRows + 1) points_.pop_front();
      speed_ = (points_.back().unwrapped_rad - points_.front().unwrapped_rad) /
               (points_.back().time_s - points_.front().time_s);
    } else {
      points_.push_back({time_s, angle_rad});
    }
    last_angle_rad_ = angle_rad;
    return speed_;
  }

 private:
  struct Point {
    double time_s;
    double unwrapped_rad;
  };
  // Averages the rounding of the file's digits (1e-4 rad after 1000 rad with 8 digits, which over
  // one period of 100 us would be 1 rad/s) and lags by 1 ms only.
  static constexpr std::size_t kRows = 20;
  std::deque<Point> points_;
  double last_angle_rad_{};
  double speed_{};
};

/// Tells a file of another sampling rate from one with drop-outs.
class SamplingRate {
 public:
  void Count(std::uint64_t steps) noexcept {
    ++rows_;
    ++of_[std::min<std::uint64_t>(steps, of_.size() - 1)];
  }
  /// The whole number of periods that more than half of the steps have; 1 when none has.
  [[nodiscard]] std::uint64_t periods() const noexcept {
    const auto most = std::ranges::max_element(of_);
    const auto steps = static_cast<std::uint64_t>(most - of_.begin());
    // Of a few rows nothing can be said, and the last count holds all longer steps.
    const bool sure = rows_ >= kFewest && 2 * *most > rows_ && steps + 1 < of_.size();
    return sure ? steps : 1;
  }

 private:
  static constexpr std::uint64_t kFewest = 10;
  std::uint64_t rows_{};
  std::array<std::uint64_t, 1002> of_{};  ///< by length: down to a thousandth of the rate
};

/// Turns rows into records: cycle numbers from time, rotation completed.
class RecordMaker {
 public:
  RecordMaker(const MeasuredData& data, const CsvLayout& layout)
      : rig_(data.rig),
        coils_(data.coils),
        has_angle_(layout.Has(CsvQuantity::kAngle)),
        has_speed_(layout.Has(CsvQuantity::kSpeed)),
        has_gap_(layout.Has(CsvQuantity::kGap)),
        has_duty_(layout.Has(CsvQuantity::kDutyTowards)),
        has_bias_(layout.Has(CsvQuantity::kBias)),
        has_coils_(layout.Has(CsvQuantity::kCoilTowards) || layout.Has(CsvQuantity::kCoilAway)) {
    if ((has_gap_ || has_duty_) && (coils_.size() < rig_.axes() || rig_.axes() != 1)) {
      throw BadInput(
          "columns of gap or duty are for a rig of one axis; give positions and currents");
    }
  }

  cycle::CycleRecord Make(CsvRow row, const RowSource& reader, ImportReport& report) {
    Advance(row, reader, report);
    Rotate(row);
    double bias_a = has_bias_ ? row.bias_current_a : rig_.bias_current_a;
    Convert(row, bias_a);
    last_ = row;
    ++report.rows;
    cycle::CycleRecord record;
    record.in.cycle = cycle_;
    record.in.frame_present = true;
    record.in.frame = {.cycle = cycle_,
                       .sample_time_ns = std::llround(row.time_s * 1e9),
                       .axes = static_cast<std::uint32_t>(rig_.axes()),
                       .position_m = row.position_m,
                       .speed_rad_per_s = row.speed_rad_per_s,
                       .angle_rad = WrapAngle(row.angle_rad)};
    record.in.op.excitation_a = row.excitation_a;
    record.in.op.excitation_m = row.excitation_m;
    if (has_coils_) {
      record.in.coils = static_cast<std::uint32_t>(2 * rig_.axes());
      record.in.coil_current_a = row.coil_current_a;
    }
    record.out.mode = row.speed_rad_per_s != 0.0 ? Mode::kSpinning : Mode::kLevitating;
    record.out.current = {.cycle = cycle_,
                          .axes = static_cast<std::uint32_t>(rig_.axes()),
                          .control_current_a = row.control_current_a,
                          .bias_current_a = bias_a,
                          .speed_set_point_rad_per_s = row.speed_rad_per_s,
                          .amplifiers_enabled = true,
                          .drive_enabled = row.speed_rad_per_s != 0.0};
    return record;
  }

  /// Refuses a file that was sampled at a whole part of the rig's rate.
  void RefuseOtherRate(const RowSource& reader) const {
    const std::uint64_t periods = rate_.periods();
    if (periods <= 1) return;
    const double hz = 1.0 / rig_.period_s();
    throw reader.Bad(fmt::format(
        "the file's rate is {:g} Hz, the rig's {:g} Hz: most of its rows are {} periods "
        "apart. {}",
        hz / static_cast<double>(periods), hz, periods, RemedyOf(periods)));
  }

 private:
  static const char* RemedyOf(std::uint64_t periods) {
    if (periods == 1'000 || periods == 1'000'000) {
      return "Times in ms or us look like this when they are read as s: say so in the map of amb "
             "import (unit: ms, unit: us), or write them in s";
    }
    return "Give a rig file with the period of the data, or resample them";
  }

  // The one axis of the rig: where it is by its gap, what was commanded by its duties.
  void Convert(CsvRow& row, double& bias_a) const {
    if (has_gap_) row.position_m[0] = coils_[0].gap_m - row.gap_m[0];
    if (!has_duty_) return;
    const double half_a = 0.5 * coils_[0].full_current_a;
    row.control_current_a[0] = half_a * (row.duty_towards[0] - row.duty_away[0]);
    bias_a = half_a * (row.duty_towards[0] + row.duty_away[0]);
  }

  void Advance(const CsvRow& row, const RowSource& reader, ImportReport& report) {
    constexpr double kLargestTimeS = 4e9;  // since 1970 until 2096; counts of ns hold twice as much
    if (!(std::abs(row.time_s) <= kLargestTimeS)) {
      throw reader.Bad(
          fmt::format("time_s is {}; allowed {} to {}", row.time_s, -kLargestTimeS, kLargestTimeS));
    }
    if (!last_) return;
    const double periods = (row.time_s - last_->time_s) / rig_.period_s();
    const double whole = std::round(periods);
    // [periods] Half of the distance at which the nearest whole step is no longer certain.
    constexpr double kAllowedOffGrid = 0.25;
    if (!(whole >= 1.0) || std::abs(periods - whole) > kAllowedOffGrid) {
      throw reader.Bad(fmt::format(
          "time_s goes from {} to {}: a step of {:.4g} periods; the rig samples every {} s and a "
          "step must be a whole number of periods",
          last_->time_s, row.time_s, periods, rig_.period_s()));
    }
    if (whole > std::round(kLongestGapS / rig_.period_s())) {
      throw reader.Bad(fmt::format(
          "time_s goes from {} to {}: a gap of {:.6g} s; allowed {:g} s. Split the file "
          "there, into one session each",
          last_->time_s, row.time_s, row.time_s - last_->time_s, kLongestGapS));
    }
    const auto steps = static_cast<std::uint64_t>(whole);
    rate_.Count(steps);
    if (steps > 1) {
      ++report.drop_outs;
      report.missing_cycles += steps - 1;
    }
    cycle_ += steps;
  }

  void Rotate(CsvRow& row) {
    if (has_angle_ && !has_speed_) row.speed_rad_per_s = slope_.Step(row.time_s, row.angle_rad);
    if (has_speed_ && !has_angle_ && last_) {
      const double mean = 0.5 * (row.speed_rad_per_s + last_->speed_rad_per_s);
      row.angle_rad = last_->angle_rad + mean * (row.time_s - last_->time_s);
    }
  }

  const RigNumbers& rig_;
  const std::vector<CoilScale>& coils_;
  bool has_angle_;
  bool has_speed_;
  bool has_gap_;
  bool has_duty_;
  bool has_bias_;
  bool has_coils_;
  SlopeOfAngle slope_;
  std::optional<CsvRow> last_;
  std::uint64_t cycle_{0};
  SamplingRate rate_;
};

ImportReport ReportOf(const CsvLayout& layout) {
  ImportReport report;
  report.ignored_columns = layout.ignored;
  report.has_rotation = layout.Has(CsvQuantity::kAngle) || layout.Has(CsvQuantity::kSpeed);
  report.has_excitation =
      layout.Has(CsvQuantity::kExcitation) || layout.Has(CsvQuantity::kPositionExcitation);
  report.has_coil_currents =
      layout.Has(CsvQuantity::kCoilTowards) || layout.Has(CsvQuantity::kCoilAway);
  return report;
}

/// The speed of the second row, where the angle has a slope, holds for the first row too.
void TakeSpeed(const cycle::CycleRecord& second, cycle::CycleRecord& first) {
  first.in.frame.speed_rad_per_s = second.in.frame.speed_rad_per_s;
  first.out.mode = second.out.mode;
  first.out.current.speed_set_point_rad_per_s = second.in.frame.speed_rad_per_s;
  first.out.current.drive_enabled = second.out.current.drive_enabled;
}

}  // namespace

ImportReport ReadRecords(RowSource& rows, const MeasuredData& data, const RecordTaker& take) {
  ImportReport report = ReportOf(rows.layout());
  RecordMaker maker(data, rows.layout());
  PlausibleValues plausible(data.rig);
  // The first row waits for the second: only then is there a slope of the angle.
  std::optional<cycle::CycleRecord> first;
  CsvRow row;
  double first_time_s = 0.0;
  while (rows.Next(row)) {
    const cycle::CycleRecord record = maker.Make(row, rows, report);
    plausible.Count(record);
    if (report.rows == 1) {
      first = record;
      first_time_s = row.time_s;
      continue;
    }
    if (first) {
      if (!rows.layout().Has(CsvQuantity::kSpeed)) TakeSpeed(record, *first);
      take(*first);
      first.reset();
    }
    take(record);
  }
  if (report.rows == 0) throw rows.Bad("no rows follow the column names");
  maker.RefuseOtherRate(rows);
  if (first) take(*first);
  report.duration_s = row.time_s - first_time_s;
  report.implausible = plausible.Found(rows.layout());
  return report;
}

}  // namespace levitas::session

#include "analysis/records/free_run.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "analysis/bare_loop.hpp"
#include "analysis/excited_rows.hpp"
#include "common/problem.hpp"

namespace levitas::analysis {
namespace {

constexpr double kTogetherS = 0.05;  // signals that begin within it are one segment's
constexpr double kApartS = 1.0;      // a pause of the same signal that ends its segment
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Squares of what is unexplained and of what there is.
struct Squares {
  double error{}, motion{};
  [[nodiscard]] double FitPercent() const {
    return motion > 0.0 ? 100.0 * (1.0 - std::sqrt(error / motion)) : kNone;
  }
};

/// Goes through one levitated interval and cuts it where the excited axes change.
class SegmentCutter {
 public:
  SegmentCutter(const session::Recording& recording, std::vector<FreeRunSegment>& made)
      : recording_(recording),
        made_(made),
        together_(RowsOf(kTogetherS)),
        apart_(RowsOf(kApartS)),
        tail_(RowsOf(kTailS)) {}

  void Cut(const session::RowRange& interval) {
    open_ = false;
    for (std::size_t row = interval.begin; row < interval.end; ++row) Take(row);
    Close(interval.end);
  }

 private:
  [[nodiscard]] std::size_t RowsOf(double seconds) const {
    return static_cast<std::size_t>(std::lround(seconds / recording_.period_s()));
  }

  void Take(std::size_t row) {
    if (!ExcitedAt(recording_, row)) return;
    if (open_ && row - last_ > apart_) Close(row);
    for (std::size_t axis = 0; axis < recording_.axes(); ++axis) {
      if (!ExcitedAt(recording_, axis, row)) continue;
      const bool known = open_ && std::ranges::find(excited_, axis) != excited_.end();
      if (open_ && !known && row - begin_ > together_) Close(row);
      if (!open_) {
        open_ = true;
        begin_ = row;
        excited_.clear();
      }
      if (std::ranges::find(excited_, axis) == excited_.end()) excited_.push_back(axis);
    }
    last_ = row;
  }

  void Close(std::size_t end) {
    if (open_) made_.push_back({{begin_, std::min(end, last_ + 1 + tail_)}, 0.0, excited_, {}});
    open_ = false;
  }

  const session::Recording& recording_;
  std::vector<FreeRunSegment>& made_;
  std::size_t together_, apart_, tail_;
  bool open_{};
  std::size_t begin_{}, last_{};
  std::vector<std::size_t> excited_;
};

AxisArray RowOfColumns(const std::vector<session::Column>& columns, std::size_t row) {
  AxisArray values{};
  for (std::size_t axis = 0; axis < columns.size(); ++axis) {
    if (!columns[axis].empty()) values[axis] = columns[axis][row];
  }
  return values;
}

/// Speed and angle of a row; of a record without rotation the rotor stands.
void TurnAs(const session::Recording& recording, std::size_t row, double earlier_s,
            BareLoop& loop) {
  const double speed = recording.speed_rad_per_s[row];
  const double angle = recording.angle_rad[row];
  const bool known = std::isfinite(speed) && std::isfinite(angle);
  loop.Turn(known ? speed : 0.0, known ? angle - speed * earlier_s : 0.0);
}

/// From the first test signal of an interval to the end of its last.
void RunInterval(const plant::PlantConfig& rig, const law::LawConfig& law,
                 const session::Recording& recording, const session::RowRange& rows,
                 FreeRun& made) {
  BareLoop loop(rig, law);
  loop.PlaceAtRest({});
  const auto settle = static_cast<std::size_t>(std::lround(kSettleS / recording.period_s()));
  TurnAs(recording, rows.begin, static_cast<double>(settle) * recording.period_s(), loop);
  for (std::size_t n = 0; n < settle; ++n) static_cast<void>(loop.Step());
  for (std::size_t row = rows.begin; row < rows.end; ++row) {
    TurnAs(recording, row, 0.0, loop);
    const AxisArray seen_m = loop.Step(RowOfColumns(recording.excitation_a, row),
                                       RowOfColumns(recording.excitation_m, row));
    for (std::size_t axis = 0; axis < recording.axes(); ++axis) {
      made.model_m[axis][row] = seen_m[axis];
    }
  }
  made.finite = made.finite && loop.finite();
}

double MeanOf(const session::Column& column, const session::RowRange& rows) {
  double sum = 0.0;
  for (std::size_t row = rows.begin; row < rows.end; ++row) sum += column[row];
  return sum / static_cast<double>(rows.end - rows.begin);
}

/// Innovation per axis by the cycle that it is of.
using Innovations = std::unordered_map<std::uint64_t, const InnovationRow*>;

Innovations ByCycle(const InnovationRun& run) {
  Innovations rows;
  rows.reserve(run.rows());
  for (const auto& piece : run.pieces) {
    for (const InnovationRow& row : piece) rows.emplace(row.cycle, &row);
  }
  return rows;
}

void Judge(const session::Recording& recording, const Innovations& innovations, FreeRun& made) {
  for (std::size_t axis = 0; axis < recording.axes(); ++axis) {
    const session::Column& measured_m = recording.position_m[axis];
    Squares all;
    Squares one_step;
    for (FreeRunSegment& segment : made.segments) {
      const double mean_m = MeanOf(measured_m, segment.rows);
      Squares own;
      for (std::size_t row = segment.rows.begin; row < segment.rows.end; ++row) {
        const double error_m = measured_m[row] - made.model_m[axis][row];
        const double motion_m = measured_m[row] - mean_m;
        own.error += error_m * error_m;
        own.motion += motion_m * motion_m;
        const auto found = innovations.find(recording.cycle[row]);
        if (found == innovations.end()) continue;
        const double innovation_m = found->second->innovation_m[axis];
        one_step.error += innovation_m * innovation_m;
        one_step.motion += motion_m * motion_m;
      }
      segment.fit_percent.push_back(own.FitPercent());
      all.error += own.error;
      all.motion += own.motion;
    }
    made.fit_percent.push_back(all.FitPercent());
    made.one_step_fit_percent.push_back(one_step.FitPercent());
  }
}

void RefuseNone(const session::Recording& recording, const std::vector<FreeRunSegment>& segments) {
  if (!segments.empty()) return;
  throw BadInput(recording.name +
                 ": no test signal while levitated, so that there is nothing a free run could be "
                 "moved by; a scenario with an excitation records one");
}

}  // namespace

std::vector<FreeRunSegment> ExcitedSegments(const session::Recording& recording) {
  std::vector<FreeRunSegment> segments;
  SegmentCutter cutter(recording, segments);
  for (const session::RowRange& interval : recording.LevitatedIntervals()) cutter.Cut(interval);
  for (FreeRunSegment& segment : segments) {
    segment.speed_rad_per_s = MeanOf(recording.speed_rad_per_s, segment.rows);
  }
  return segments;
}

void RefuseUnexcited(const session::Recording& recording) {
  RefuseNone(recording, ExcitedSegments(recording));
}

FreeRun RunFree(const plant::PlantConfig& rig, const law::LawConfig& law,
                const session::Recording& recording, const InnovationRun& one_step) {
  FreeRun made;
  made.segments = ExcitedSegments(recording);
  RefuseNone(recording, made.segments);
  made.model_m.assign(recording.axes(), session::Column(recording.rows(), kNone));
  for (const session::RowRange& interval : recording.LevitatedIntervals()) {
    session::RowRange excited{interval.end, interval.begin};
    for (const FreeRunSegment& segment : made.segments) {
      if (segment.rows.begin < interval.begin || segment.rows.end > interval.end) continue;
      excited.begin = std::min(excited.begin, segment.rows.begin);
      excited.end = std::max(excited.end, segment.rows.end);
    }
    if (excited.begin < excited.end) RunInterval(rig, law, recording, excited, made);
  }
  Judge(recording, ByCycle(one_step), made);
  return made;
}

}  // namespace levitas::analysis

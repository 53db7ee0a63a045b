#include "identification/nonlinear/loop_record.hpp"

#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "common/problem.hpp"
#include "common/rotational_speed.hpp"
#include "session/exchange/recording.hpp"

namespace levitas::identification {
namespace {

using Index = Eigen::Index;

constexpr double kStandingRadPerS = 2.0 * std::numbers::pi;  ///< 60 rpm: gyroscopics are nothing
constexpr std::size_t kLeastRows = 100;

bool Excited(const session::Recording& run, std::size_t row) {
  for (std::size_t axis = 0; axis < run.axes(); ++axis) {
    if (run.ExcitationOf(axis, row) != 0.0 || run.PositionExcitationOf(axis, row) != 0.0) {
      return true;
    }
  }
  return false;
}

/// From the first excited row of a levitated interval to the end of that interval.
session::RowRange ExcitedRows(const session::Recording& run) {
  for (const session::RowRange& interval : run.LevitatedIntervals()) {
    for (std::size_t row = interval.begin; row < interval.end; ++row) {
      if (Excited(run, row)) return {row, interval.end};
    }
  }
  throw BadInput(run.name +
                 ": no excitation in the record; record a scenario that excites all axes");
}

void RefuseUnfit(const session::Recording& run, const session::RowRange& rows) {
  if (rows.end - rows.begin < kLeastRows) {
    throw BadInput(fmt::format("{}: {} levitated rows follow the first excited one, needed are {}",
                               run.name, rows.end - rows.begin, kLeastRows));
  }
  for (std::size_t row = rows.begin; row < rows.end; ++row) {
    if (std::abs(run.speed_rad_per_s[row]) > kStandingRadPerS) {
      throw BadInput(fmt::format(
          "{}: the rotor turns at {:.0f} rpm in cycle {}: needed is a record of its standstill",
          run.name, RadPerSToRpm(run.speed_rad_per_s[row]), run.cycle[row]));
    }
  }
}

}  // namespace

LoopRecord ReadLoopRecord(const std::string& path, const configuration::RigFile& rig) {
  const session::Recording run = session::LoadRecording(path, rig);
  const session::RowRange rows = ExcitedRows(run);
  RefuseUnfit(run, rows);
  const Eigen::MatrixXd empty(static_cast<Index>(rows.end - rows.begin),
                              static_cast<Index>(run.axes()));
  LoopRecord loop{{run.period_s(), run.channels, run.channels, empty, empty}, {empty, empty}};
  for (std::size_t row = rows.begin; row < rows.end; ++row) {
    const auto k = static_cast<Index>(row - rows.begin);
    for (std::size_t axis = 0; axis < run.axes(); ++axis) {
      const auto i = static_cast<Index>(axis);
      loop.series.input(k, i) = run.current_a[axis][row];
      loop.series.output(k, i) = run.position_m[axis][row];
      loop.excitation.position_m(k, i) = run.PositionExcitationOf(axis, row);
      loop.excitation.current_a(k, i) = run.ExcitationOf(axis, row);
    }
  }
  return loop;
}

}  // namespace levitas::identification

#include "identification/nonlinear/loop_record.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/problem.hpp"
#include "common/rotational_speed.hpp"
#include "session/session_reader.hpp"

namespace levitas::identification {
namespace {

using Index = Eigen::Index;

constexpr double kStandingRadPerS = 2.0 * std::numbers::pi;  ///< 60 rpm: gyroscopics are nothing
constexpr std::size_t kLeastRows = 100;

bool Excited(const cycle::OperatorInput& op, std::size_t axes) {
  const auto any = [axes](const AxisArray& values) {
    return std::any_of(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(axes),
                       [](double value) { return value != 0.0; });
  };
  return any(op.excitation_m) || any(op.excitation_a);
}

bool Levitated(Mode mode) { return mode == Mode::kLevitating || mode == Mode::kSpinning; }

std::vector<cycle::CycleRecord> ExcitedRows(const std::string& path, const RigNumbers& rig) {
  session::SessionReader session(path);
  std::vector<cycle::CycleRecord> rows;
  cycle::CycleRecord record;
  while (session.Next(record)) {
    if (rows.empty() && !(Levitated(record.out.mode) && Excited(record.in.op, rig.axes()))) {
      continue;
    }
    const bool follows = rows.empty() || record.in.cycle == rows.back().in.cycle + 1;
    if (!follows || !record.in.frame_present || !Levitated(record.out.mode)) break;
    if (std::abs(record.in.frame.speed_rad_per_s) > kStandingRadPerS) {
      throw BadInput(fmt::format(
          "{}: the rotor turns at {:.0f} rpm in cycle {}: needed is a record of its standstill",
          path, RadPerSToRpm(record.in.frame.speed_rad_per_s), record.in.cycle));
    }
    rows.push_back(record);
  }
  return rows;
}

}  // namespace

LoopRecord ReadLoopRecord(const std::string& path, const RigNumbers& rig) {
  const auto rows = ExcitedRows(path, rig);
  if (rows.empty()) {
    throw BadInput(path + ": no excitation in the record; record a scenario that excites all axes");
  }
  if (rows.size() < kLeastRows) {
    throw BadInput(fmt::format("{}: {} levitated rows follow the first excited one, needed are {}",
                               path, rows.size(), kLeastRows));
  }
  if (rows.front().in.frame.axes != rig.axes()) {
    throw BadInput(fmt::format("{}: {} channels, rig {} has {}", path, rows.front().in.frame.axes,
                               rig.name, rig.axes()));
  }
  const auto axes = static_cast<Index>(rig.axes());
  const Eigen::MatrixXd empty(static_cast<Index>(rows.size()), axes);
  LoopRecord loop{{rig.period_s(), rig.channels, rig.channels, empty, empty}, {empty, empty}};
  for (Index k = 0; k < empty.rows(); ++k) {
    const cycle::CycleRecord& row = rows[static_cast<std::size_t>(k)];
    for (Index i = 0; i < axes; ++i) {
      const auto at = static_cast<std::size_t>(i);
      loop.series.input(k, i) = rig.actuator_polarity[at] * row.out.current.control_current_a[at];
      loop.series.output(k, i) = rig.sensor_polarity[at] * row.in.frame.position_m[at];
      loop.excitation.position_m(k, i) = row.in.op.excitation_m[at];
      loop.excitation.current_a(k, i) = row.in.op.excitation_a[at];
    }
  }
  return loop;
}

}  // namespace levitas::identification

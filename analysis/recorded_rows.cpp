#include "analysis/recorded_rows.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "common/problem.hpp"

namespace levitas::analysis {
namespace {

void RefuseOtherRig(const session::SessionHeader& header, const RigNumbers& rig) {
  if (header.period_ns != rig.period_ns) {
    throw BadInput(fmt::format(
        "the session was sampled every {} us, rig {} every {} us: use the rig file it was "
        "recorded with",
        static_cast<double>(header.period_ns) * 1e-3, rig.name,
        static_cast<double>(rig.period_ns) * 1e-3));
  }
  if (header.channels != rig.channels) {
    throw BadInput(fmt::format(
        "the session has the channels {}, rig {} has {}: use the rig file it was recorded with",
        fmt::join(header.channels, ", "), rig.name, fmt::join(rig.channels, ", ")));
  }
}

bool Levitated(const cycle::CycleRecord& record, std::size_t axes) {
  const Mode mode = record.out.mode;
  const bool flying =
      mode == Mode::kLevitating || mode == Mode::kSpinning || mode == Mode::kCoastDown;
  const auto& position_m = record.in.frame.position_m;
  return flying && record.in.frame_present && record.out.current.amplifiers_enabled &&
         std::all_of(position_m.begin(), position_m.begin() + static_cast<std::ptrdiff_t>(axes),
                     [](double value) { return std::isfinite(value); });
}

RecordedRow RowOf(const cycle::CycleRecord& record, std::size_t axes) {
  const SensorFrame& frame = record.in.frame;
  const CurrentFrame& current = record.out.current;
  RecordedRow row;
  row.cycle = frame.cycle;
  row.levitated = Levitated(record, axes);
  row.excitation_a = record.in.op.excitation_a;
  row.coil_current_a = record.in.coil_current_a;
  row.coils = record.in.coils;
  row.sample.position_m = frame.position_m;
  row.sample.command.control_current_a = current.control_current_a;
  row.sample.command.bias_current_a = current.bias_current_a;
  row.sample.command.amplifiers_enabled = current.amplifiers_enabled;
  row.sample.speed_rad_per_s = frame.speed_rad_per_s;
  row.sample.angle_rad = frame.angle_rad;
  return row;
}

}  // namespace

std::vector<RecordedRow> ReadRows(session::SessionReader& session, const RigNumbers& rig) {
  RefuseOtherRig(session.header(), rig);
  std::vector<RecordedRow> rows;
  cycle::CycleRecord record;
  while (session.Next(record)) rows.push_back(RowOf(record, rig.axes()));
  return rows;
}

double MeanSpeed(const std::vector<RecordedRow>& rows) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const RecordedRow& row : rows) {
    if (!row.levitated) continue;
    sum += row.sample.speed_rad_per_s;
    ++count;
  }
  return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

}  // namespace levitas::analysis

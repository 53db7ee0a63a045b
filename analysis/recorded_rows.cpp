#include "analysis/recorded_rows.hpp"

#include "session/recording.hpp"

namespace levitas::analysis {
namespace {

RecordedRow RowOf(const cycle::CycleRecord& record, std::size_t axes) {
  const SensorFrame& frame = record.in.frame;
  const CurrentFrame& current = record.out.current;
  RecordedRow row;
  row.cycle = frame.cycle;
  row.levitated = session::IsLevitated(record, axes);
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
  session::RefuseOtherRig(session.header(), rig);
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

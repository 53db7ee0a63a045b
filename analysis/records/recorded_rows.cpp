#include "analysis/records/recorded_rows.hpp"

#include <algorithm>
#include <cmath>

namespace levitas::analysis {
namespace {

RecordedRow RowOf(const session::Recording& recording, std::size_t row) {
  RecordedRow made;
  for (std::size_t axis = 0; axis < recording.axes(); ++axis) {
    made.sample.position_m[axis] = recording.position_m[axis][row];
    made.sample.command.control_current_a[axis] = recording.current_a[axis][row];
    made.excitation_a[axis] = recording.ExcitationOf(axis, row);
  }
  for (std::size_t coil = 0; coil < recording.coil_current_a.size(); ++coil) {
    const double measured_a = recording.coil_current_a[coil][row];
    if (std::isnan(measured_a)) continue;
    made.coil_current_a[coil] = measured_a;
    made.coils = static_cast<std::uint32_t>(coil + 1);
  }
  made.cycle = recording.cycle[row];
  made.levitated = recording.levitated[row] != 0;
  made.sample.command.bias_current_a = recording.bias_current_a[row];
  made.sample.command.amplifiers_enabled = recording.amplifiers_enabled[row] != 0;
  made.sample.speed_rad_per_s = recording.speed_rad_per_s[row];
  made.sample.angle_rad = recording.angle_rad[row];
  return made;
}

}  // namespace

void FindAccelerations(double period_s, std::vector<RecordedRow>& rows) {
  // Slopes of the speed over so long to either side: speeds of a tachometer scatter from sample to
  // sample.
  constexpr double kHalf = 0.025;  // [s]
  const auto half = static_cast<std::size_t>(std::llround(kHalf / period_s));
  for (std::size_t first = 0; first < rows.size();) {
    std::size_t end = first + 1;
    // A frame that was lost stands in a session as a row of the cycle before.
    while (end < rows.size() && rows[end].cycle >= rows[end - 1].cycle &&
           rows[end].cycle - rows[end - 1].cycle <= kMostLost + 1)
      ++end;
    for (std::size_t i = first; i < end; ++i) {
      const RecordedRow& from = rows[i - std::min(half, i - first)];
      const RecordedRow& to = rows[std::min(i + half, end - 1)];
      if (to.cycle == from.cycle) continue;
      rows[i].sample.acceleration_rad_per_s2 =
          (to.sample.speed_rad_per_s - from.sample.speed_rad_per_s) /
          (static_cast<double>(to.cycle - from.cycle) * period_s);
    }
    first = end;
  }
}

std::vector<RecordedRow> RowsOf(const session::Recording& recording) {
  std::vector<RecordedRow> rows;
  rows.reserve(recording.rows());
  for (std::size_t row = 0; row < recording.rows(); ++row) {
    rows.push_back(RowOf(recording, row));
  }
  FindAccelerations(recording.period_s(), rows);
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

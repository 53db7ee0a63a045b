#include "diagnosis/records/levitated_interval.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/records/recorded_rows.hpp"

namespace levitas::diagnosis {
namespace {

bool Far(const RigView& rig, const analysis::RecordedRow& row) {
  for (std::size_t a = 0; a + 1 < rig.axes; a += 2) {
    const double limit_m = kFree * rig.bearing(a).touchdown.clearance_m;
    const double radius_m = std::hypot(row.sample.position_m[a], row.sample.position_m[a + 1]);
    if (limit_m > 0.0 && radius_m > limit_m) return true;
  }
  return false;
}

bool WithoutCurrent(const RigView& rig, const analysis::RecordedRow& row) {
  const auto& current_a = row.sample.command.control_current_a;
  return std::all_of(current_a.begin(), current_a.begin() + static_cast<std::ptrdiff_t>(rig.axes),
                     [](double value) { return value == 0.0; });
}

}  // namespace

void LeaveOutContact(const RigView& rig, Record& record) {
  auto& rows = record.rows;
  const auto margin = static_cast<std::size_t>(std::llround(kMargin / rig.period_s));
  std::vector<bool> contact(rows.size(), false);
  std::size_t off = 0;
  for (std::size_t n = 0; n < rows.size(); ++n) {
    off = WithoutCurrent(rig, rows[n]) ? off + 1 : 0;
    contact[n] = off >= kOff || Far(rig, rows[n]);
  }
  // Forwards, then backwards: no row is looked at more than twice.
  std::size_t left = 0;
  for (std::size_t n = 0; n < rows.size(); ++n) {
    left = contact[n] ? margin + 1 : left;
    if (left == 0) continue;
    --left;
    rows[n].levitated = false;
  }
  left = 0;
  for (std::size_t n = rows.size(); n-- > 0;) {
    left = contact[n] ? margin + 1 : left;
    if (left == 0) continue;
    --left;
    rows[n].levitated = false;
  }
  std::erase_if(rows, [](const analysis::RecordedRow& row) { return !row.levitated; });
  record.mean_speed_rad_per_s = analysis::MeanSpeed(rows);
}

}  // namespace levitas::diagnosis

#include "diagnosis/record_errors/columns.hpp"

#include <algorithm>

#include "diagnosis/model/repeated_frames.hpp"

namespace levitas::diagnosis {
namespace {

constexpr std::size_t kSpans = 4;

/// Of the axes whose test signal is in none of the spans: where the middle of its rows lies.
std::vector<std::size_t> MissedTestSignals(const Record& record, std::size_t axes,
                                           const std::vector<std::size_t>& levitated,
                                           const std::vector<std::size_t>& starts,
                                           std::size_t length) {
  std::vector<std::size_t> missed;
  for (std::size_t a = 0; a < axes; ++a) {
    std::vector<std::size_t> excited;
    for (std::size_t i = 0; i < levitated.size(); ++i) {
      if (record.rows[levitated[i]].excitation_a[a] != 0.0) excited.push_back(i);
    }
    const auto holds = [&](std::size_t from) {
      const auto first = std::ranges::lower_bound(excited, from);
      const auto last = std::ranges::lower_bound(excited, from + length);
      return static_cast<std::size_t>(last - first) >= length / kSpans;
    };
    if (excited.empty() || std::ranges::any_of(starts, holds)) continue;
    missed.push_back(excited[excited.size() / 2]);
  }
  return missed;
}

/// Rows of the record that are taken, in its order.
std::vector<std::size_t> Taken(const Record& record, std::size_t axes, std::size_t most_rows) {
  std::vector<std::size_t> levitated;
  for (std::size_t n = 0; n < record.rows.size(); ++n) {
    if (record.rows[n].levitated) levitated.push_back(n);
  }
  if (levitated.size() <= most_rows) return levitated;
  const std::size_t length = most_rows / kSpans;
  const std::size_t last = levitated.size() - length;
  std::vector<std::size_t> starts;
  for (std::size_t s = 0; s < kSpans; ++s) starts.push_back(s * last / (kSpans - 1));
  for (const std::size_t at : MissedTestSignals(record, axes, levitated, starts, length)) {
    starts.push_back(std::min(at > length / 2 ? at - length / 2 : 0, last));
  }
  std::ranges::sort(starts);
  std::vector<std::size_t> taken;
  std::size_t next = 0;
  for (const std::size_t from : starts) {
    for (std::size_t i = std::max(from, next); i < from + length; ++i)
      taken.push_back(levitated[i]);
    next = from + length;
  }
  return taken;
}

}  // namespace

double CurrentLimit(const RigView& rig, std::size_t axis) {
  const auto& magnet = rig.bearing(axis).magnet;
  return std::min(magnet.bias_current_a, magnet.max_coil_current_a - magnet.bias_current_a);
}

Columns ColumnsOf(const Record& record, const RigView& rig, std::size_t most_rows) {
  const std::vector<std::size_t> taken = Taken(record, rig.axes, most_rows);
  const auto rows = static_cast<Eigen::Index>(taken.size());
  const auto axes = static_cast<Eigen::Index>(rig.axes);
  Columns out;
  out.name = record.name;
  for (Eigen::MatrixXd* matrix : {&out.position_m, &out.current_a, &out.excitation_a}) {
    matrix->resize(rows, axes);
  }
  out.angle_rad.resize(rows);
  out.speed_rad_per_s.resize(rows);
  out.missing.resize(taken.size());
  out.repeated.resize(taken.size());
  for (Eigen::Index n = 0; n < rows; ++n) {
    const auto i = static_cast<std::size_t>(n);
    const analysis::RecordedRow& row = record.rows[taken[i]];
    for (Eigen::Index a = 0; a < axes; ++a) {
      const auto axis = static_cast<std::size_t>(a);
      out.position_m(n, a) = row.sample.position_m[axis];
      out.current_a(n, a) = row.sample.command.control_current_a[axis];
      out.excitation_a(n, a) = row.excitation_a[axis];
    }
    out.angle_rad[n] = row.sample.angle_rad;
    out.speed_rad_per_s[n] = row.sample.speed_rad_per_s;
    out.missing[i] = kNewSpan;
    if (n == 0) continue;
    const analysis::RecordedRow& before = record.rows[taken[i - 1]];
    // A span that begins where the one before it ended is the same span.
    if (row.cycle > before.cycle) out.missing[i] = row.cycle - before.cycle - 1;
    out.repeated[i] =
        out.missing[i] == 0 && Repeats(before.sample.position_m, row.sample.position_m, rig.axes)
            ? 1
            : 0;
  }
  out.mean_speed_rad_per_s = rows > 0 ? out.speed_rad_per_s.mean() : 0.0;
  return out;
}

}  // namespace levitas::diagnosis

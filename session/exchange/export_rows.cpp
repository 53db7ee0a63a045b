#include "session/exchange/export_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "common/nearest.hpp"
#include "common/problem.hpp"
#include "common/rotational_speed.hpp"
#include "session/log/session_reader.hpp"

namespace levitas::session {
namespace {

/// The nanosecond of a limit; one beyond what a count can hold is none.
std::int64_t Nanoseconds(double seconds) {
  using Limits = std::numeric_limits<std::int64_t>;
  constexpr double kMostS = 9e9;
  if (std::abs(seconds) > kMostS) return seconds > 0.0 ? Limits::max() : Limits::min();
  return static_cast<std::int64_t>(std::round(1e9 * seconds));
}

/// The selection, refused where it can hold no row.
const ExportSelection& Checked(const ExportSelection& selection) {
  if (std::isnan(selection.from_s) || std::isnan(selection.to_s) ||
      selection.from_s > selection.to_s) {
    throw Problem(ExitStatus::kUsage,
                  fmt::format("--from {} s, --to {} s: expected a time and a later one",
                              selection.from_s, selection.to_s));
  }
  if (selection.every == 0) {
    throw Problem(ExitStatus::kUsage, "--every 0: expected a whole number from 1");
  }
  return selection;
}

/// "torque_motor_to_pinion_n_m": names of columns have no blanks.
std::string ColumnOf(const char* quantity, std::string coupling, const char* unit) {
  std::replace(coupling.begin(), coupling.end(), ' ', '_');
  return quantity + coupling + unit;
}

}  // namespace

ExportRows::ExportRows(const SessionHeader& header, const ExportSelection& selection,
                       TorsionRecording torsion)
    : names_{"time_s", "rotor_angle_rad", "speed_rpm"},
      axes_(header.channels.size()),
      injects_position_(header.scenario_yaml.find("point: measured_position") != std::string::npos),
      lowers_bias_(header.controller_yaml.find("\nbias_saving:") != std::string::npos),
      torsion_(std::move(torsion)),
      from_ns_(Nanoseconds(Checked(selection).from_s)),
      to_ns_(Nanoseconds(selection.to_s)),
      every_(selection.every),
      period_ns_(static_cast<std::uint64_t>(header.period_ns)),
      from_zero_(header.pace == "realtime") {
  const auto name_all = [&](const char* quantity, const char* unit) {
    for (const auto& channel : header.channels) names_.push_back(quantity + channel + unit);
  };
  name_all("position_", "_m");
  name_all("control_current_", "_a");
  name_all("excitation_", "_a");
  if (injects_position_) name_all("excitation_", "_m");
  if (lowers_bias_) names_.emplace_back("bias_current_a");
  for (const std::string& name : torsion_.couplings) {
    names_.push_back(ColumnOf("torque_", name, "_n_m"));
    names_.push_back(ColumnOf("twist_", name, "_rad"));
  }
  names_.emplace_back("mode");
  Choose(selection);
}

void ExportRows::Choose(const ExportSelection& selection) {
  if (selection.columns.empty()) {
    chosen_.resize(names_.size() - 1);
    std::iota(chosen_.begin(), chosen_.end(), std::size_t{0});
    return;
  }
  for (const std::string& column : selection.columns) {
    if (column == names_.front()) continue;  // always there
    const auto found = std::find(names_.begin(), names_.end(), column);
    if (found == names_.end()) {
      throw Problem(ExitStatus::kUsage,
                    fmt::format("--columns: the session has no column '{}'; nearest: {}. All: {}",
                                column, Nearest(column, names_), Listed(names_)));
    }
    const auto value = static_cast<std::size_t>(found - names_.begin()) - 1;
    if (std::find(chosen_.begin(), chosen_.end(), value) != chosen_.end()) {
      throw Problem(ExitStatus::kUsage, fmt::format("--columns: '{}' is named twice", column));
    }
    chosen_.push_back(value);
  }
  if (chosen_.empty()) {
    throw Problem(ExitStatus::kUsage, "--columns time_s: expected a column besides the time");
  }
  std::vector<std::string> names{names_.front()};
  for (const std::size_t value : chosen_) names.push_back(names_[value + 1]);
  names_ = std::move(names);
}

// Modulo 2^64: stamps that no rig gives, of a file that lies, must not be undefined.
std::int64_t ExportRows::TimeOf(const cycle::CycleInputs& in) {
  const auto sample_ns = static_cast<std::uint64_t>(in.frame.sample_time_ns);
  if (!started_) {
    offset_ns_ = from_zero_ ? 0U - sample_ns : 0U;
  } else if (in.frame.rig_session != rig_session_) {
    // A new rig counts anew: the controller's own count bridges the restart.
    offset_ns_ = time_ns_ + (in.cycle - cycle_) * period_ns_ - sample_ns;
  }
  started_ = true;
  rig_session_ = in.frame.rig_session;
  cycle_ = in.cycle;
  time_ns_ = sample_ns + offset_ns_;
  return static_cast<std::int64_t>(time_ns_);
}

bool ExportRows::AskedFor(std::int64_t time_ns) {
  if (time_ns < from_ns_ || time_ns > to_ns_) return false;
  return within_++ % every_ == 0;
}

std::int64_t ExportRows::Next(const cycle::CycleRecord& record, std::vector<double>& values) {
  const SensorFrame& frame = record.in.frame;
  values.clear();
  const std::int64_t time_ns = TimeOf(record.in);
  if (!AskedFor(time_ns)) return time_ns;
  all_.clear();
  all_.push_back(frame.angle_rad);
  all_.push_back(RadPerSToRpm(frame.speed_rad_per_s));
  const auto add = [&](const AxisArray& numbers) {
    for (std::size_t axis = 0; axis < axes_; ++axis) all_.push_back(numbers[axis]);
  };
  add(frame.position_m);
  add(record.out.current.control_current_a);
  add(record.in.op.excitation_a);
  if (injects_position_) add(record.in.op.excitation_m);
  if (lowers_bias_) all_.push_back(record.out.current.bias_current_a);
  if (!torsion_.couplings.empty()) {
    const auto row = torsion_.RowOf(frame.rig_session, frame.cycle);
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t c = 0; c < torsion_.couplings.size(); ++c) {
      all_.push_back(row ? torsion_.torque_n_m[c][*row] : kNone);
      all_.push_back(row ? torsion_.twist_rad[c][*row] : kNone);
    }
  }
  all_.push_back(static_cast<double>(record.out.mode));
  for (const std::size_t value : chosen_) values.push_back(all_[value]);
  return time_ns;
}

ExportReport ExportRows::ForEach(SessionReader& reader, const Take& take) {
  ExportReport report;
  cycle::CycleRecord record;
  std::vector<double> values;
  while (reader.Next(record)) {
    if (!record.in.frame_present) {
      ++report.cycles_without_frame;
      continue;
    }
    const std::int64_t time_ns = Next(record, values);
    if (values.empty()) continue;
    take(time_ns, values);
    ++report.rows;
  }
  return report;
}

}  // namespace levitas::session

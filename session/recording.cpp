#include "session/recording.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <utility>

#include "common/levitated_modes.hpp"
#include "common/problem.hpp"
#include "session/candump_import.hpp"
#include "session/coil_scales.hpp"
#include "session/csv_rows.hpp"
#include "session/mat_rows.hpp"
#include "session/measured_data.hpp"
#include "session/packed_log.hpp"
#include "session/record_frame.hpp"
#include "session/session_reader.hpp"

namespace levitas::session {
namespace {

/// Appends `value`; a column stays empty until a value is not zero.
void AppendUnlessZero(Column& column, double value, std::size_t rows_before) {
  if (column.empty() && value == 0.0) return;
  if (column.empty()) column.assign(rows_before, 0.0);
  column.push_back(value);
}

/// Takes cycle records into the columns of a recording.
class ColumnWriter {
 public:
  ColumnWriter(const std::string& path, const RigNumbers& rig) : frame_(rig), axes_(rig.axes()) {
    recording_.name = path;
    recording_.period_ns = rig.period_ns;
    recording_.channels = rig.channels;
    for (std::size_t axis = 0; axis < axes_; ++axis) {
      recording_.sensor_range_m.push_back(rig.SensorRangeOf(axis / 2));
    }
    recording_.current_limit_a =
        std::min(rig.bias_current_a, rig.max_coil_current_a - rig.bias_current_a);
    for (auto* columns : {&recording_.position_m, &recording_.current_a, &recording_.excitation_a,
                          &recording_.excitation_m}) {
      columns->assign(axes_, {});
    }
  }

  void Take(const cycle::CycleRecord& record) {
    const SensorFrame& frame = record.in.frame;
    const CurrentFrame& command = record.out.current;
    TakeCoils(record.in);
    for (std::size_t axis = 0; axis < axes_; ++axis) {
      AppendUnlessZero(recording_.excitation_a[axis], record.in.op.excitation_a[axis],
                       recording_.rows());
      AppendUnlessZero(recording_.excitation_m[axis], record.in.op.excitation_m[axis],
                       recording_.rows());
    }
    const AxisSample sample = frame_.Bearing(record);
    for (std::size_t axis = 0; axis < axes_; ++axis) {
      recording_.position_m[axis].push_back(sample.position_m[axis]);
      recording_.current_a[axis].push_back(sample.current_a[axis]);
    }
    recording_.levitated.push_back(IsLevitated(record, axes_) ? 1 : 0);
    recording_.amplifiers_enabled.push_back(command.amplifiers_enabled ? 1 : 0);
    recording_.speed_rad_per_s.push_back(frame.speed_rad_per_s);
    recording_.angle_rad.push_back(frame.angle_rad);
    recording_.bias_current_a.push_back(command.bias_current_a);
    recording_.cycle.push_back(frame.cycle);
    recording_.time_s.push_back(1e-9 * static_cast<double>(frame.sample_time_ns));
  }

  void SetDamage(std::string text) { recording_.damage = std::move(text); }

  /// Gives the recording away, without spare room.
  Recording Finish() {
    recording_.cycle.shrink_to_fit();
    recording_.levitated.shrink_to_fit();
    recording_.amplifiers_enabled.shrink_to_fit();
    for (Column* column : {&recording_.time_s, &recording_.speed_rad_per_s, &recording_.angle_rad,
                           &recording_.bias_current_a}) {
      column->shrink_to_fit();
    }
    for (auto* columns : {&recording_.position_m, &recording_.current_a, &recording_.excitation_a,
                          &recording_.excitation_m, &recording_.coil_current_a}) {
      for (Column& column : *columns) column.shrink_to_fit();
    }
    return std::move(recording_);
  }

 private:
  // The first record that has coil currents adds their columns; rows without are NaN.
  void TakeCoils(const cycle::CycleInputs& in) {
    auto& coils = recording_.coil_current_a;
    if (in.coils > coils.size()) {
      coils.resize(in.coils, Column(recording_.rows(), std::nan("")));
    }
    for (std::size_t coil = 0; coil < coils.size(); ++coil) {
      coils[coil].push_back(coil < in.coils ? in.coil_current_a[coil] : std::nan(""));
    }
  }

  RecordFrame frame_;
  std::size_t axes_;
  Recording recording_;
};

bool EndsWithEither(const std::string& path, const std::string& ending) {
  return path.ends_with(ending) || path.ends_with(ending + ".xz");
}

/// First bytes of a file; none of a file that is empty or cannot be read.
std::string StartOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string start(4096, '\0');
  file.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(file.gcount()));
  return start;
}

/// An LCM event log has a sync word at the beginning of each event; or it is packed.
bool MayBeSession(const std::string& start) {
  return start.find("\xED\xA1\xDA\x01") != std::string::npos ||
         BeginsPacked(std::vector<std::uint8_t>(start.begin(), start.end()));
}

void TakeSession(const std::string& path, const RigNumbers& rig, ColumnWriter& columns) {
  // What is wrong with an empty, absent or damaged file is for the session reader to say.
  const std::string start = StartOf(path);
  if (!start.empty() && !MayBeSession(start)) {
    throw BadInput(fmt::format(
        "{}: not a session. A recorded run is a session (amb run --record), CSV by the ending .csv "
        "or .csv.xz, MAT by .mat, with the columns of docs/formats.md, or a log of candump by .log "
        "or .log.xz. Any other table of measured values: amb import --guess {} shows how to read "
        "it",
        path, path));
  }
  try {
    SessionReader session(path);
    RefuseOtherRig(session.header(), rig);
    cycle::CycleRecord record;
    while (session.Next(record)) columns.Take(record);
    columns.SetDamage(session.damage().Text());
  } catch (const BadInput& refused) {
    const std::string text = refused.what();
    throw BadInput(text.starts_with(path) ? text : fmt::format("{}: {}", path, text));
  }
}

void TakeBusLog(const std::string& path, const config::RigFile& rig, const RecordTaker& take) {
  if (rig.buses.empty()) {
    throw BadInput(rig.numbers.name + ": names no CAN buses (section buses, docs/real_rig.md)");
  }
  static_cast<void>(
      ReadCandump(path, can::MakeLayout(rig.numbers, can::FormatOf(rig.buses)), take));
}

}  // namespace

std::vector<std::size_t> Recording::Gaps() const {
  std::vector<std::size_t> gaps;
  for (std::size_t row = 1; row < rows(); ++row) {
    if (!Follows(row)) gaps.push_back(row);
  }
  return gaps;
}

std::vector<RowRange> Recording::LevitatedIntervals() const {
  std::vector<RowRange> intervals;
  for (std::size_t row = 0; row < rows(); ++row) {
    if (levitated[row] == 0) continue;
    const bool continues = Follows(row) && levitated[row - 1] != 0;
    if (continues) {
      intervals.back().end = row + 1;
    } else {
      intervals.push_back({row, row + 1});
    }
  }
  return intervals;
}

bool IsLevitated(const cycle::CycleRecord& record, std::size_t axes) noexcept {
  const auto& position_m = record.in.frame.position_m;
  return levitas::IsLevitated(record.out.mode) && record.in.frame_present &&
         record.out.current.amplifiers_enabled &&
         std::all_of(position_m.begin(), position_m.begin() + static_cast<std::ptrdiff_t>(axes),
                     [](double value) { return std::isfinite(value); });
}

void RefuseOtherRig(const SessionHeader& header, const RigNumbers& rig) {
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

bool IsSession(const std::string& path) {
  if (EndsWithEither(path, ".csv") || path.ends_with(".mat")) return false;
  return !EndsWithEither(path, ".log") || MayBeSession(StartOf(path));
}

Recording LoadRecording(const std::string& path, const config::RigFile& rig) {
  ColumnWriter columns(path, rig.numbers);
  const RecordTaker take = [&columns](const cycle::CycleRecord& record) { columns.Take(record); };
  const std::vector<CoilScale> coils = CoilScales(rig.plant, rig.numbers.axes());
  const MeasuredData data{.rig = rig.numbers, .coils = coils};
  if (EndsWithEither(path, ".csv")) {
    CsvRows rows(path, rig.numbers.channels);
    static_cast<void>(ReadRecords(rows, data, take));
  } else if (path.ends_with(".mat")) {
    MatRows rows(path, rig.numbers.channels, rig.log.matrix, rig.log.rows);
    static_cast<void>(ReadRecords(rows, data, take));
  } else if (IsSession(path)) {
    TakeSession(path, rig.numbers, columns);
  } else {
    TakeBusLog(path, rig, take);
  }
  return columns.Finish();
}

}  // namespace levitas::session

#include "session/exchange/recording.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "common/levitated_modes.hpp"
#include "common/problem.hpp"
#include "session/exchange/candump_import.hpp"
#include "session/exchange/coil_scales.hpp"
#include "session/exchange/csv_rows.hpp"
#include "session/exchange/mat_rows.hpp"
#include "session/exchange/measured_data.hpp"
#include "session/exchange/recording_builder.hpp"
#include "session/log/packed_log.hpp"
#include "session/log/session_reader.hpp"

namespace levitas::session {
namespace {

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

void TakeSession(const std::string& path, const RigNumbers& rig, RecordingBuilder& columns) {
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

void TakeBusLog(const std::string& path, const configuration::RigFile& rig,
                const RecordTaker& take) {
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

Recording LoadRecording(const std::string& path, const configuration::RigFile& rig) {
  RecordingBuilder columns(path, rig.numbers);
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

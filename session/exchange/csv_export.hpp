#pragma once
// A session as CSV of the contract in docs/formats.md.
//
// Columns   of export_rows.hpp. Numbers are the shortest that read back to the same bits; speed_rpm
//           has 12 digits, so that the conversion to rad/s and back ends at the same text.
// Rows      one per sensor frame; a cycle without a new frame has no row (a gap in time). time_s
//           of the sample. In real time it starts at 0; when the rig restarts it runs on.
// Failure   BadInput when the file cannot be written.

#include <cstdint>
#include <string>

#include "session/exchange/export_rows.hpp"
#include "session/log/session_reader.hpp"

namespace levitas::session {

/// Reads the rest of `reader`. The file appears under its name when it is complete.
ExportReport ExportCsv(SessionReader& reader, const std::string& csv_path,
                       const ExportSelection& selection = {});

/// Seconds with all digits of the nanoseconds and none too many: 100000 -> "0.0001".
[[nodiscard]] std::string SecondsText(std::int64_t time_ns);

}  // namespace levitas::session

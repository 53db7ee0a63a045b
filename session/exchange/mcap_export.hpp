#pragma once
// A session as an MCAP file, which Foxglove and PlotJuggler open.
//
// Channels  /levitas/cycle: a message per sensor frame, the columns of export_rows.hpp as doubles;
//           /levitas/event: all that happened, as text. Encoded as protobuf, types inside the file.
// Metadata  "levitas": the session's header, rig, controller and scenario as texts.
// Time      start of the run plus the time of export_rows.hpp.
// Failure   BadInput when the file cannot be written.

#include <string>

#include "session/exchange/csv_export.hpp"

namespace levitas::session {

/// Reads the rest of `reader`. The file appears under its name when it is complete.
ExportReport ExportMcap(SessionReader& reader, const std::string& mcap_path,
                        const ExportSelection& selection = {});

}  // namespace levitas::session

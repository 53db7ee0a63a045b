#pragma once
// The rig of a command that reads records: the one that the session was recorded with, unless
// --rig names another.
//
// Default   the rig in the header of the first session among the records; the others must hold the
//           same. Records that hold none (CSV, MAT, candump) are taken as of the rig that
//           AnalysisOptions names by default.
// Same      every number of the rig and its tolerances; its name, the files that `run` names, lines
//           of the GPIO chip and the layout of its logs change no answer.
// Said      on standard error, one line each: that --rig differs from a session's, naming both and
//           the first value that differs; that a session's rig has effects of its own, which the
//           model then has too.
// Failure   BadInput: sessions of different rigs and no --rig; a rig that cannot be read.
// Thread    any.

#include <string>
#include <vector>

#include "cli/options/analysis_options.hpp"

namespace levitas::cli {

/// --rig, whose default is the rig of the session.
void AddRigOfRecordsOption(CLI::App& command, AnalysisOptions& options);

[[nodiscard]] configuration::RigFile LoadRigOfRecords(const AnalysisOptions& options,
                                                      const std::vector<std::string>& records);

struct WhichRigs {
  const char* first{"in the session"};
  const char* second{"in the file"};
};

/// "magnet.gap_mm: 0.5 in the session, 0.4 in the file" of the first value that differs; empty
/// where both are the same rig.
[[nodiscard]] std::string RigDifference(const configuration::RigFile& first_rig,
                                        const configuration::RigFile& second_rig,
                                        const WhichRigs& which = {});

}  // namespace levitas::cli

#pragma once
// Why a run's files are not whole: what the recorder said, and which disk is full.
//
// Thread   any. Failure: none; what cannot be found out is empty.

#include <string>
#include <vector>

namespace levitas::cli {

/// "no space is left in A, B", of those folders (or folders of files) whose disk takes no more;
/// empty when all do.
[[nodiscard]] std::string NoRoom(const std::vector<std::string>& paths);

/// The controller's own sentence on a recording that it had to stop, from its log; empty if none.
[[nodiscard]] std::string RecordingStopped(const std::string& controller_log);

/// What the controller said of the files in the trip folder: those it removed, those it found.
[[nodiscard]] std::vector<std::string> TripFolderNotes(const std::string& controller_log);

}  // namespace levitas::cli

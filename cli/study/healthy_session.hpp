#pragma once
// The last accepted session of a rig, to compare a doubtful record with (`amb diagnose --healthy`).
//
// Among    the catalogue of sessions (session_index) of this rig's name: accepted, begun before
//          the records did (where they are sessions), still there, none of the records, and of a
//          rig with the same channels and period.
// Failure  none: without a catalogue, or with one that cannot be read, there is no such session.
// Thread   any.

#include <string>
#include <vector>

#include "configuration/rig_file.hpp"

namespace levitas::cli {

/// Empty where there is none.
[[nodiscard]] std::string LastAcceptedSession(const configuration::RigFile& rig,
                                              const std::vector<std::string>& records);

}  // namespace levitas::cli

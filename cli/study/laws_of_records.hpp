#pragma once
// The laws that records were made with: of a session its own; of any other record the one that the
// rig file names (key run, controller).
//
// Same      records of the same law, name and text, share an entry.
// Unknown   records of which there is none, or one that cannot be read for this rig.
// Thread    any. Failure: none.

#include <string>
#include <vector>

#include "configuration/rig_file.hpp"
#include "diagnosis/report/levitation.hpp"

namespace levitas::cli {

[[nodiscard]] diagnosis::KnownLaws LawsOfRecords(const std::vector<std::string>& records,
                                                 const configuration::RigFile& rig);

}  // namespace levitas::cli

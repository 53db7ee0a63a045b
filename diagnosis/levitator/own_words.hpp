#pragma once
// The numbers of a levitator's diagnosis under the keys and in the units of the rig file, where it
// has a key for them: factors on the file's number, micrometres, bandwidths.
//
// Thread  any; pure.

#include "config/rig_file.hpp"
#include "diagnosis/levitator/search.hpp"
#include "diagnosis/report/diagnose_files.hpp"

namespace levitas::levitator {

/// `found` was fitted beside `origin`; what is told is both together, as a rig file would have it.
[[nodiscard]] diagnosis::OwnWords OwnWordsOf(const config::RigFile& rig, const Theta& origin,
                                             const Found& found);

}  // namespace levitas::levitator

#pragma once
// The numbers of a levitator's diagnosis under the keys and in the units of the rig file, where it
// has a key for them: factors on the file's number, micrometres, bandwidths.
//
// Thread  any; pure.

#include "config/rig_file.hpp"
#include "diagnosis/levitator/search.hpp"
#include "diagnosis/session.hpp"

namespace levitas::levitator {

[[nodiscard]] diagnosis::OwnWords OwnWordsOf(const config::RigFile& rig, const Found& found);

}  // namespace levitas::levitator

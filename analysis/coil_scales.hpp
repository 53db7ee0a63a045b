#pragma once
// Gap and full current of each coil under the name that callers of analysis use.
//
// Thread  any; pure.

#include "session/coil_scales.hpp"

namespace levitas::analysis {

using session::CoilScales;

}  // namespace levitas::analysis

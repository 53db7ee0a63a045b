#pragma once
// What each controller of a recorded run saw and commanded, for law_fit.hpp.
//
// Input     the reading plus what a test signal added to it; output the command less what a test
//           signal added to that. Bearing frame, both of the same row: the law's answer to a
//           sample.
// Rows      of the longest levitated interval; of an axis that was excited, from its first excited
//           row to its last.
// Thread    any.
// Failure   BadInput: no levitated rows, a current at its limit (the law is cut off there).

#include <vector>

#include "identification/law/law_fit.hpp"
#include "session/exchange/recording.hpp"

namespace levitas::identification {

/// One entry per axis, in the order of the channels.
[[nodiscard]] std::vector<LawSignals> ReadLawSignals(const session::Recording& run);

}  // namespace levitas::identification

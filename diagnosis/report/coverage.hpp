#pragma once
// What records can and cannot tell, whatever is found in them: "nothing is hidden" holds only for
// what would have shown.
//
// Rotation   a rotor that does not turn shows nothing that turns with it.
// Test       without a test signal the currents hold little but the feedback of noise: what the
//            loop does to them hardly shows. A CSV without the column does not say that it holds
//            one, and counts as if it held none.
// Thread     any; pure.

#include <string>
#include <vector>

#include "diagnosis/report/session.hpp"

namespace levitas::diagnosis {

struct Coverage {
  bool turns{};    ///< faster than a slow roll
  bool excited{};  ///< by a test signal
};

[[nodiscard]] Coverage CoverageOf(const SessionAnswer& answer);
/// Effects that would not show, or hardly.
[[nodiscard]] std::vector<std::string> CannotTell(const SessionAnswer& answer);
/// One sentence of what the records cannot tell; empty when they can tell all.
[[nodiscard]] std::string CannotTellSentence(const SessionAnswer& answer);
/// What to record for that; empty when nothing is missing.
[[nodiscard]] std::string MissingRecords(const SessionAnswer& answer);

}  // namespace levitas::diagnosis

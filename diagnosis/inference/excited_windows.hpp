#pragma once
// Which stretches of a long record a first answer reads, where evenly spread ones would miss its
// test signals.
//
// Missed   an axis with a test signal of which the even stretches hold less than half of their
//          share of the rows: what that magnet does is then hardly in them.
// Chosen   for each axis with a test signal in turn the stretch that holds most of it, then the
//          fastest one without overlap: rotation has effects of its own. In order of time.
// Not      where the rows are too few for a stretch of each axis that is longer than the model's
//          settling: the even ones stay.
// Thread   any; pure.

#include <cstddef>
#include <vector>

#include "analysis/records/innovations.hpp"

namespace levitas::diagnosis {

struct Window {
  std::size_t first{}, length{};  ///< rows
};

/// `even` where it misses nothing, or where the record has no test signal. `shortest` [rows]: less
/// would hold little but the settling of the model.
[[nodiscard]] std::vector<Window> TellingWindows(const std::vector<analysis::RecordedRow>& rows,
                                                 std::vector<Window> even, std::size_t shortest);

}  // namespace levitas::diagnosis

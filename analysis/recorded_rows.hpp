#pragma once
// A session as the rows an observer is driven with.
//
// Levitated  the amplifiers are on, the mode is levitating, spinning or coast-down, the frame
//            arrived and its positions are numbers. Imported records are levitated throughout.
// Failure    BadInput when the session was sampled at another period or has other channels than
//            the rig: the model would answer a question that was not asked.
// Thread     any.

#include <vector>

#include "analysis/innovations.hpp"
#include "common/rig_numbers.hpp"
#include "session/session_reader.hpp"

namespace levitas::analysis {

/// Reads the session to its end.
[[nodiscard]] std::vector<RecordedRow> ReadRows(session::SessionReader& session,
                                                const RigNumbers& rig);

/// Mean over the levitated rows; 0 when there are none.
[[nodiscard]] double MeanSpeed(const std::vector<RecordedRow>& rows);

}  // namespace levitas::analysis

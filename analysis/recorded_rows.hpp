#pragma once
// A recorded run as the rows that an observer is driven with.
//
// Frame      bearing frame, as that of the observer's plant.
// Levitated  session/recording.hpp says of which rows.
// Coils      a row has the currents of all coils up to the last that was measured in it.
// Memory     328 bytes a row (3.3 MB a second at 10 kHz) besides the recording.
// Failure    BadInput when the session was sampled at another period or has other channels than
//            the rig: the model would answer a question that was not asked.
// Thread     any.

#include <vector>

#include "analysis/innovations.hpp"
#include "common/rig_numbers.hpp"
#include "session/recording.hpp"
#include "session/session_reader.hpp"

namespace levitas::analysis {

/// Reads the session to its end.
[[nodiscard]] std::vector<RecordedRow> ReadRows(session::SessionReader& session,
                                                const RigNumbers& rig);

[[nodiscard]] std::vector<RecordedRow> RowsOf(const session::Recording& recording);

/// Mean over the levitated rows; 0 when there are none.
[[nodiscard]] double MeanSpeed(const std::vector<RecordedRow>& rows);

}  // namespace levitas::analysis

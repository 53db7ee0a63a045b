#pragma once
// A recorded run as the rows that an observer is driven with.
//
// Frame      bearing frame, as that of the observer's plant.
// Levitated  session/exchange/recording.hpp says of which rows.
// Coils      a row has the currents of all coils up to the last that was measured in it.
// Memory     328 bytes a row (3.3 MB a second at 10 kHz) besides the recording.
// Thread     any.

#include <cstdint>
#include <vector>

#include "analysis/records/innovations.hpp"
#include "session/exchange/recording.hpp"

namespace levitas::analysis {

[[nodiscard]] std::vector<RecordedRow> RowsOf(const session::Recording& recording);

/// Frames lost in a row over which a record goes on; more are a pause.
inline constexpr std::uint64_t kMostLost = 20;

/// Sets RecordedSample::acceleration_rad_per_s2 of rows that follow one another.
void FindAccelerations(double period_s, std::vector<RecordedRow>& rows);

/// Mean over the levitated rows; 0 when there are none.
[[nodiscard]] double MeanSpeed(const std::vector<RecordedRow>& rows);

}  // namespace levitas::analysis

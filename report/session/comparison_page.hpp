#pragma once
// A comparison of recorded runs as one HTML page that needs nothing beside it: table of the
// synchronous amplitudes, orbits side by side on one scale, amplitude over speed.
//
// Colours  one per record, the same in every picture; the legend and the dashes name them too.
// Thread   any. Failure: none; names of others are escaped.

#include <string>
#include <vector>

#include "report/session/comparison.hpp"
#include "report/session/pictures.hpp"

namespace levitas::report {

/// Orbits of each bearing, a panel per speed; then the amplitudes of positions and currents of
/// each axis over speed. `circle_um` is the objective's radius; 0: none is drawn.
[[nodiscard]] std::vector<NamedPicture> ComparisonPictures(const Comparison& comparison,
                                                           double circle_um);

/// `table` is the text that the command prints.
[[nodiscard]] std::string ComparisonPage(const Comparison& comparison, const std::string& table,
                                         double circle_um);

}  // namespace levitas::report

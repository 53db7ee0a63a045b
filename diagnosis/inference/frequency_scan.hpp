#pragma once
// Other starts of a calibration for the frequencies of bending modes.
//
// Why      a lightly damped mode high in the band answers within a few widths of its frequency
//          alone, and those are narrower than the file's tolerance: the cost has a valley at every
//          line of chance, and derivatives lead into the nearest one. That the mode does not ring
//          there is then laid on its damping.
// Method   for a mode whose damping or frequency ended off the file: the cost on a grid over four
//          tolerances to both sides of the healthy rig's frequency, and next to the best of it with
//          the healthy rig's damping.
// Not      where a number that is no mode's lies more than three tolerances off the file. A cause
//          is missing then, and modes elsewhere imitate it too well to leave it any evidence.
// Thread   of the caller; pure but for `cost`.

#include <functional>
#include <vector>

#include "diagnosis/model/point.hpp"
#include "diagnosis/model/term.hpp"

namespace levitas::diagnosis {

/// The point of the grids at which `cost` [nat] is least, mode by mode; `start` where none is
/// lower than its own by more than chance makes it. A cost that is not finite is never the least.
[[nodiscard]] Point AlongFrequencies(const std::vector<Term>& terms,
                                     const std::function<double(const Point&)>& cost, Point start);

}  // namespace levitas::diagnosis

#pragma once
// Where a search begins: what is known to differ from the laws' own numbers before anything is
// fitted, by the effects of the rig file or by healthy records.
//
// Composed   ratios multiply, all else adds: 0 beside an origin is the origin.
// Failure    BadInput for effects of the file that no number of the table stands for, and for those
//            that set in later: passed over, they would be found again as a cause.
// Thread     any; pure.

#include "config/rig_file.hpp"
#include "diagnosis/levitator/parameters.hpp"

namespace levitas::levitator {

/// The effects of a rig file, in the table's numbers.
[[nodiscard]] Theta EffectsOf(const config::RigFile& file);
/// What a rig file says in the table's own numbers: its effects, and what of its coils' law is not
/// there unless it says so.
[[nodiscard]] Theta OriginOf(const config::RigFile& file);
/// One number of the table.
[[nodiscard]] double Beside(std::size_t parameter, double origin, double theta);
/// The least that a number may be beside an origin: what is there may be less, down to nothing.
[[nodiscard]] double LeastBeside(std::size_t parameter, double origin);
/// What `theta` is beside an origin; numbers of single records stay as they are.
[[nodiscard]] Theta Beside(const Theta& origin, Theta theta);

}  // namespace levitas::levitator

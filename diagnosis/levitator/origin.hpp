#pragma once
// Where a search begins: what is known to differ from the laws' own numbers before anything is
// fitted, by the effects of the rig file or by healthy records.
//
// Composed   ratios multiply, all else adds: 0 composed with an origin is the origin.
// Failure    BadInput for effects of the file that no number of the table stands for, and for those
//            that set in later: passed over, they would be found again as a cause.
// Thread     any; pure.

#include "configuration/rig_file.hpp"
#include "diagnosis/levitator/parameters.hpp"

namespace levitas::levitator {

/// The effects of a rig file, in the table's numbers.
[[nodiscard]] Theta EffectsOf(const configuration::RigFile& file);
/// The rig file as values of the table: its effects, and terms of its coils that are zero unless
/// the file sets them.
[[nodiscard]] Theta OriginOf(const configuration::RigFile& file);
/// One number of the table.
[[nodiscard]] double ComposedWith(std::size_t parameter, double origin, double theta);
/// Lower bound relative to the origin: an effect already present may shrink to zero.
[[nodiscard]] double LowerBound(std::size_t parameter, double origin);
/// `theta` composed with an origin; parameters of single records stay as they are.
[[nodiscard]] Theta ComposedWith(const Theta& origin, Theta theta);

}  // namespace levitas::levitator

#pragma once
// The plant with what the terms in force change of it, instead of additions to what it does.
//
// Why     a change that a term adds is held over a period, which is right as long as a mode turns
//         little within it: of the shift of a mode at f it makes sin(2 pi f T) / (2 pi f T), 72 %
//         at a fifth of the sampling rate. Modes of a rig that is a few per cent off its file would
//         be calibrated to values that no healthy rig has.
// Takes   frequencies and damping of the modes, gyroscopic moments: Term::in_plant.
// Limits  damping ratios within 0 to 0.999 and frequencies from a thousandth of the file's on, of
//         which a plant can be made; a fit that goes beyond gains nothing there.
// Thread  any; pure.

#include <memory>

#include "diagnosis/model/linear_change.hpp"
#include "diagnosis/model/rig_view.hpp"

namespace levitas::diagnosis {

/// The rig's own model where nothing of the kind changes; else a new one: microseconds.
[[nodiscard]] std::shared_ptr<const plant::PlantModel> PlantAt(const RigView& rig,
                                                               const LinearChange& change);

}  // namespace levitas::diagnosis

#pragma once
// Lines of the full spectrum from a record of a geared rig, and what its rig file knows of it.
//
// Stretch   of steady_stretches.hpp; at least two of different speed.
// Lines     least squares of sum_k R_k exp(j k theta) over a stretch, theta the rotor's angle
//           unwrapped over the whole record: the gear's order is no whole number. k = 0, +-1,
//           -+ z_p/z_g, +- i z_p. Standard deviations from what remains.
// Chain     readings are divided by sensor gain and lag; commands become coil currents by delay,
//           hold and amplifier lag, all of the rig file.
// Sign      a record's control current pulls in the positive direction, +ki ic
//           (docs/conventions.md); the lines have that of the equations, -ki I, so I = -ic.
// Limit     the gear's phase counts from the record's first row: a record that begins in another
//           turn of the pinion gives it with another half turn (20 to 40 teeth).
// Failure   BadInput: a rig without one gear pair on two shafts with a bearing each, or with a
//           shaft that one plane of probes does not tell (elastic_of_rig.hpp); a record without two
//           steady speeds, missing rows, dead, clipped or saturated channels.
// Thread    any.

#include <vector>

#include "configuration/rig_file.hpp"
#include "identification/geared/full_spectrum.hpp"
#include "session/exchange/recording.hpp"

namespace levitas::identification {

[[nodiscard]] GearedKnown KnownOfRig(const configuration::RigFile& rig);

[[nodiscard]] std::vector<GearedLine> LinesOfRecord(const session::Recording& record,
                                                    const configuration::RigFile& rig,
                                                    int harmonics = 5);

}  // namespace levitas::identification

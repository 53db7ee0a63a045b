#pragma once
// A rig as a healthy one of its file may be: everything that `tolerances` states and an uncertainty
// leaves out is drawn.
//
// Drawn      normal, limited to three deviations: bandwidths, gains, offsets, run-out and places of
//            the probes, bandwidth of the amplifiers, delay, mass and gyroscopic effect of the
//            rotor, unbalance, a static force per disc; of geared shafts what belongs to axes.
// Left out   deflections of the modes, which no rig file can hold beside its shaft; what the
//            uncertainty draws: frequency and damping of its modes, ki and ks.
// Units      of the file's tolerances. Thread: any; pure.

#include "common/random.hpp"
#include "configuration/rig_file.hpp"

namespace levitas::uncertainty {

/// Numbers of the file change where the file has them, the rest is added as entries of `effects`;
/// nothing else changes.
[[nodiscard]] configuration::RigFile DrawWithin(const configuration::RigFile& rig, Random& draw);

}  // namespace levitas::uncertainty

#pragma once
// Identified numbers as a rig file: what its keys can hold, the rest stays the file's.
//
// Modal     force constant and gap, sensor gain per bearing (means of its axes), delay; what an
//           axis differs by as entries of `effects` (current_gain, displacement_stiffness,
//           sensor_gain). Entries of the file that these numbers hold already, those that
//           set in later excepted, are left out.
// Rotor     as modes: rigid body, frequencies, damping, deflections and gyroscopic matrix
//           (identified_rotor.hpp). As the file's shaft: frequency and damping of every mode that
//           the data show as entries of `effects`; deflections, gyroscopic matrix and rigid body
//           stay the shaft's, which keeps what needs a shaft (a crack).
// Geared    force constant and gap per bearing, run-outs, mesh, transmission error.
// ks        is that of the working point: a simulation of the file adds the magnet's own hardening
//           with current again, a few per cent.
// Failure   BadInput when ki or ks of a bearing is not positive: no magnet is like that. Thread
// any.

#include "configuration/rig_file.hpp"
#include "identification/geared/full_spectrum.hpp"
#include "identification/modal/identify_modal.hpp"

namespace levitas::identification {

enum class RotorForm { kModes, kShaft };

[[nodiscard]] configuration::RigFile IdentifiedRig(const configuration::RigFile& rig,
                                                   const ModalResult& found, RotorForm form);
[[nodiscard]] configuration::RigFile IdentifiedRig(const configuration::RigFile& rig,
                                                   const GearedParameters& found);

}  // namespace levitas::identification

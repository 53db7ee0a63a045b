#pragma once
// The rotor of a modal identification as a rigid body with modes (rig key `rotor.modal`): what was
// measured at the planes of sensors and magnets, and the file's shapes between them.
//
// Shape     of a fitted mode: the file's at every node plus the measured difference, straight
//           between the planes and constant beyond the outermost; planes at one place share the
//           mean of theirs. Modes above the fitted ones are the file's.
// Scale     modal mass 1 kg: deflections are those of mass-normalised modes [1/sqrt(kg)].
// Gyroscopic  of tilt and fitted modes as found, with modes above them as the file has it.
// Does not  hold a shaft: a breathing crack, which bends it, needs one (BadInput names it).
// Thread    any; pure.

#include "configuration/rig_file.hpp"
#include "identification/modal/identify_modal.hpp"

namespace levitas::identification {

[[nodiscard]] rotor::GivenRotor IdentifiedRotor(const configuration::RigFile& rig,
                                                const ModalResult& found);

}  // namespace levitas::identification

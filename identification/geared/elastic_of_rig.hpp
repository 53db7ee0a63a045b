#pragma once
// The elastic model of a geared rig's shaft, as its rig file describes it.
//
// Model     the modes that the simulation keeps, with the springs and dampers that the shaft stands
//           on; planes of its gear, its magnet and that magnet's probes (elastic_shaft.hpp).
// Failure   BadInput naming shaft and key: no support; a support unlike in x and y, which couples
//           forward and backward lines; an unbalance on the shaft, a second force that one plane of
//           probes does not tell from the run-out's; a gear without eccentric mass, whose run-out
//           no force shows. Thread any; a modal reduction.

#include "configuration/rig_file.hpp"
#include "identification/geared/full_spectrum.hpp"
#include "plant_sim/plant/plant_model.hpp"

namespace levitas::identification {

/// A beam, or a disc with supports besides its own stiffness.
[[nodiscard]] bool IsElastic(const rotor::Shaft& shaft);

/// `index` of the shaft, `wheel` on it; the shaft has one bearing. All but ratio, ki and ks.
[[nodiscard]] ShaftKnown ElasticOfRig(const configuration::RigFile& rig,
                                      const plant::PlantModel& model, const gear::Wheel& wheel);

}  // namespace levitas::identification

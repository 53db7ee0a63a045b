#pragma once
// The generalised plant of a rig at rest, one for each set of axes that do not meet at rest.
//
// Plant      plant::Linearise at speed 0 about the centred rotor, split into its unconnected parts
//            (x and y plane of an isotropic rotor), plant::Discretise with the rig's delay, then
//            the inverse of Tustin: continuous, exact for the sampled loop. Forces and
//            perturbations of modes enter behind the delay.
// Order      inputs: perturbations of modes, force at the disc, disturbances, noises, u;
//            outputs: modes, weighted currents, weighted positions, y.
// Units      u [A], y [um]; everything else is a ratio to its weight.
// Failure    BadInput for weights (hinf_weights.hpp). Thread: any; pure.

#include "design/hinf/hinf_weights.hpp"
#include "design/synthesis/plant_rank.hpp"
#include "plant_sim/plant/plant_config.hpp"

namespace levitas::hinf {

struct PlanePlant {
  std::vector<std::size_t> axes;     ///< of the rig, ascending
  std::vector<std::size_t> same_as;  ///< axes of planes with the same matrices, one after another
  synthesis::GeneralisedPlant plant;
};

/// `top_speed_rad_per_s` sizes the force at the disc.
[[nodiscard]] std::vector<PlanePlant> BuildPlanes(const plant::PlantConfig& rig,
                                                  const HinfWeights& weights,
                                                  double top_speed_rad_per_s);

}  // namespace levitas::hinf

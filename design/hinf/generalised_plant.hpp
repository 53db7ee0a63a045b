#pragma once
// The generalised plant of a rig: its linear model with delay, the weights, the uncertain modes.
//
// Plant      plant::Linearise at the design speed about the centred rotor, plant::Discretise with
//            the rig's delay, then the inverse of Tustin: continuous, exact for the sampled loop.
// Order      inputs: mode perturbations (one per flexible mode and plane), disturbances, noises, u;
//            outputs: mode perturbations, weighted currents, weighted positions, y.
// Units      u [A], y [um]; everything else is a ratio to its weight.
// Reduced    states whose Hankel singular value is below 0.01 um/A are left out: a current
//            of the largest size moves them by less than the sensor noise.
// Failure    Problem for a rig without period or with contradicting weights, naming the weight.
// Thread     any; pure.

#include "design/hinf/hinf_weights.hpp"
#include "design/synthesis/plant_rank.hpp"
#include "design/synthesis/uncertainty_blocks.hpp"
#include "plant_sim/plant/plant_config.hpp"

namespace levitas::hinf {

struct WeightedPlant {
  synthesis::GeneralisedPlant plant;
  synthesis::UncertaintyBlocks blocks;  ///< one per mode and plane, then the performance block
  double period_s{};
};

[[nodiscard]] WeightedPlant BuildPlant(const plant::PlantConfig& rig, const HinfWeights& weights,
                                       double speed_rad_per_s);

}  // namespace levitas::hinf

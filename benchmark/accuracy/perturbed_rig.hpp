#pragma once
// The rig behind measured data: the nominal one with everything a little off, as on a real rig, and
// with what is hidden in it.
//
// Deviations normal, limited to two standard deviations: Mismatch. They are this file's own and not
//            read from the diagnosis.
// Model      ten modes per plane where the rig file has eight, seven integration steps where it has
//            four.
// Thread     any.

#include <vector>

#include "benchmark/accuracy/perturbed_train.hpp"
#include "common/random.hpp"
#include "plant_sim/plant/plant_parameters.hpp"

namespace levitas::accuracy {

/// Standard deviations of what a healthy rig is off by.
struct Mismatch {
  double current_gain{0.025}, displacement_stiffness{0.025};  ///< per axis
  double amplifier_bandwidth{0.04};
  double sensor_gain{0.008};
  double sensor_bandwidth{0.04};
  double sensor_offset_m{7e-6};
  double sensor_position_m{0.4e-3};
  double sensor_runout_m{0.8e-6};
  double delay_samples{0.04};
  double modal_frequency{0.007}, modal_damping{0.25}, modal_shape{0.015};
  double rotor_mass{0.004};        ///< of all of the rigid body: its inertia is off with it
  double transverse_inertia{0.0};  ///< beside that; 0 draws nothing
  double gyroscopic_inertia{0.015};
  double unbalance_kg_m{2e-6};
  double static_load_n{0.7};
  TrainMismatch train;  ///< of geared shafts
};

/// `hidden` joins the entries of the mismatch; on one place they combine.
[[nodiscard]] plant::PlantParameters PerturbedRig(const plant::PlantConfig& nominal,
                                                  const Mismatch& mismatch,
                                                  const std::vector<effect::EffectConfig>& hidden,
                                                  Random& random);

}  // namespace levitas::accuracy

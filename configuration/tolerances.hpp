#pragma once
// By how much a rig that counts as healthy may differ from its file: standard deviations, each of a
// normal distribution about the number in the file.
//
// Used by  the diagnosis (docs/diagnosis.md): what lies within these is calibrated, not named.
// Default  what a carefully commissioned rig shows; a rig file states its own under `tolerances`.
// Thread   plain data.

namespace levitas::configuration {

struct Tolerances {
  double current_gain{0.03};            ///< ki, per axis
  double displacement_stiffness{0.03};  ///< ks, per axis
  double amplifier_bandwidth{0.05};
  double sensor_gain{0.01};
  double sensor_bandwidth{0.05};
  double sensor_offset_m{10e-6};
  double sensor_position_m{0.5e-3};
  double sensor_runout_m{1e-6};  ///< once per turn, each of cosine and sine
  double delay_samples{0.05};
  double modal_frequency{0.01};
  double modal_damping{0.3};
  double modal_shape{0.02};  ///< of its rms along the shaft
  double rotor_mass{0.005};
  double gyroscopic_inertia{0.02};
  double unbalance_kg_m{3e-6};  ///< each of cosine and sine, per plane
  double static_load_n{1.0};    ///< per axis
  // Geared shafts.
  double shaft_stiffness{0.02}, shaft_damping{0.2};
  double mesh_stiffness{0.03}, mesh_damping{0.2};
  double transmission_error_m{0.3e-6};  ///< each of cosine and sine, per order
  double gear_runout_m{1e-6};           ///< each of cosine and sine, per wheel
};

}  // namespace levitas::configuration

#pragma once
// The plant linearised: about the centred rotor, for observers and identification; about the point
// at which the levitated rotor stands (find_operating_point.hpp), for poles and margins.
//
// Continuous   x' = A x + B ic,  y = C x : states ordered as StateLayout, magnet F = ki ic + ks x,
//              amplifier and sensor filters included, no contact, gravity, unbalance or noise;
//              the measured curve of a probe by its slope at the centre.
// Effects      those that are linear and do not depend on the rotor's angle, at the strengths the
//              model has; extra_delay is PlantModel::delay_samples(). Left out: hysteresis (its
//              state is there, decays and acts on nothing), slew, rub, anisotropy, crack, all
//              signals.
// Discrete     zero-order hold over one period with the rig's delay as extra states (the commands
//              not yet acting); exact for whole and fractional delays.
// Frame        bearing frame, polarities undone: what a law sees. docs/derivations.md (41)-(44).
// Thread       any; allocates.

#include <Eigen/Core>

#include "plant_sim/plant/plant_config.hpp"

namespace levitas::plant {

struct LinearModel {
  Eigen::MatrixXd a;
  Eigen::MatrixXd b;
  Eigen::MatrixXd c;
};

class PlantModel;

/// Continuous model at a constant speed. Each magnet carries its design bias.
[[nodiscard]] LinearModel Linearise(const PlantConfig& config, double speed_rad_per_s);
/// The same of a model that exists already, parameters set by name included.
[[nodiscard]] LinearModel Linearise(const PlantModel& model, double speed_rad_per_s);

struct OperatingPoint;

/// About a static operating point, coil by coil; at the centre when the point is.
[[nodiscard]] LinearModel Linearise(const PlantModel& model, double speed_rad_per_s,
                                    const OperatingPoint& point);

/// Sampled model: x[n+1] = A x[n] + B u[n], y[n] = C x[n], with u[n] the command from sample n.
[[nodiscard]] LinearModel Discretise(const LinearModel& continuous, double period_s,
                                     double delay_samples);

}  // namespace levitas::plant

#pragma once
// What the unbalance of a rig file does to its sensors without any control current: the disturbance
// that synchronous control answers.
//
// Result   complex amplitudes of the positions at once the speed, as multiples of e^{j angle}
//          [m]; empty for geared shafts and rigs without unbalance.
// Thread   any; pure.

#include <Eigen/Core>

#include "configuration/rig_file.hpp"

namespace levitas::design {

[[nodiscard]] Eigen::VectorXcd UnbalanceAtSensors(const config::RigFile& rig,
                                                  double speed_rad_per_s);

/// Largest radius of an ellipse of two complex amplitudes, over the bearings.
[[nodiscard]] double LargestRadius(const Eigen::VectorXcd& position_m);

}  // namespace levitas::design

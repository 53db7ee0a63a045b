#pragma once
// Where a levitated rotor stands under its static load, and what the magnets do there.
//
// Equation   0 = x'(x, u) of the plant with its true magnet force, closed by the law at rest: a law
//            that integrates brings its reading to the reference, one that does not asks for
//            u = -C(1) y and lets the rotor sag. Newton's method.  docs/derivations.md (41a), (41b)
// Load       gravity, static_load, uneven coils, springs at the shaft, offsets of the sensors.
//            Left out: curves of the sensors, hysteresis, unbalance, torque of gears. A rig whose
//            coils are on a voltage counts as centred.
// Units      SI; bearing frame. Thread: any; allocates.
// Failure    OperatingPoint::failure.

#include <Eigen/Core>
#include <vector>

#include "plant_sim/plant/linear_parts.hpp"
#include "plant_sim/plant/operating_point.hpp"

namespace levitas::plant {

/// The law as it is at frequency 0.
struct StaticLaw {
  Eigen::MatrixXd gain_a_per_m;  ///< C(1), without the minus sign; rows of integrators unused
  std::vector<bool> integrates;  ///< per channel
  double limit_a{};              ///< |ic| of the law; 0 = what the coils allow
};

[[nodiscard]] OperatingPoint FindOperatingPoint(const PlantModel& model, double speed_rad_per_s,
                                                const StaticLaw& law);

/// Slopes of the force of both coils at the point, by central differences of the force that the
/// simulation uses: relative error below 1e-8.
[[nodiscard]] Slopes SlopesAt(const PlantModel& model, std::size_t bearing,
                              const OperatingPoint& point);

}  // namespace levitas::plant

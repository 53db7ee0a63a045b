#pragma once
// Rotation of the shaft: driven towards a set point, or coasting down.
//
// Equation   driven:   dW/dt = limit, towards the set point and never past it
//            coasting: dW/dt = -c W - d sign(W), until it stands. docs/derivations.md (26)-(28).
//            contact:  J dW/dt = M besides, driven or not, of the friction's torque M (28a).
// Thread     any; pure. Not done: torsion of the shaft.

#include "plant_sim/plant/plant_config.hpp"

namespace levitas::plant {

struct Rotation {
  double speed_rad_per_s{};
  double angle_rad{};                ///< 0 <= angle < 2 pi
  double acceleration_rad_per_s2{};  ///< mean of the latest step
};

/// Advances by `duration_s`; closed form for constant limits.
void Drive(Rotation& rotation, double set_point_rad_per_s, double limit_rad_per_s2,
           double duration_s) noexcept;
void Coast(Rotation& rotation, const DriveConfig& drive, double duration_s) noexcept;

/// Torque of contact friction. It ends at the latest where nothing slides any more: within a step
/// it cannot turn the sliding round.
void Brake(Rotation& rotation, double polar_inertia_kg_m2, double torque_n_m, double slip_rad_per_s,
           double duration_s) noexcept;

/// The angle brought to 0 <= angle < 2 pi.
[[nodiscard]] double Wrapped(double angle_rad) noexcept;

}  // namespace levitas::plant

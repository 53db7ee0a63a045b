#pragma once
// Laws the analysis is tested with, and a rotor whose poles are closed forms.

#include "common/rotational_speed.hpp"
#include "controller/law/law_config.hpp"
#include "plant_sim/plant/plant_config.hpp"

namespace levitas::test {

/// Law of the flexible rotor (Sahinkaya & Sawicki), as the reference poles have it.
[[nodiscard]] law::LawConfig FlexibleRotorLaw();

/// Rigid cylinder between two equal bearings at +-kCylinderArm of its centre, nearly ideal
/// amplifiers and sensors, 1 us period: its poles are those of two quadratics.
[[nodiscard]] plant::PlantConfig RigidCylinder();
inline constexpr double kCylinderLength = 0.3;      // [m]
inline constexpr double kCylinderDiameter = 0.04;   // [m]
inline constexpr double kCylinderArm = 0.1;         // [m]
inline constexpr double kCylinderDensity = 7800.0;  // [kg/m3]

/// The same PD law, without integrator and filters, for all axes of a rig.
[[nodiscard]] law::LawConfig PdLaw(const plant::PlantConfig& plant, double kp_a_per_m,
                                   double kd_a_s_per_m, double derivative_hz);

}  // namespace levitas::test

#pragma once
// Matrices of one Timoshenko beam element of circular section, in one plane of r = x + j y.
//
// Unknowns   deflection and slope at each end: (r1, r1', r2, r2').
// Equations  docs/derivations.md (1)-(6). Source: Nelson (1980), "A finite rotating shaft element
//            using Timoshenko beam theory"; shear coefficient of a solid circle: Cowper (1966).
// Units      SI. Not done: axial load, torque, taper; hollow sections use the solid coefficient.

#include <Eigen/Core>

#include "plant_sim/rotor/rotor_config.hpp"

namespace levitas::rotor {

struct BeamElement {
  Eigen::Matrix4d mass;        ///< translation and rotary inertia
  Eigen::Matrix4d gyroscopic;  ///< per unit speed
  Eigen::Matrix4d stiffness;
};

/// `piece.length_m` is the length of the element.
[[nodiscard]] BeamElement MakeBeamElement(const Material& material, const Section& piece);

[[nodiscard]] double CrossSectionM2(const Section& piece);

}  // namespace levitas::rotor

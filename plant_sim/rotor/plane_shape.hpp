#pragma once
// Mode shapes at any place of the shaft, between the nodes as well.
//
// Equation   cubic Hermite interpolation of deflection and slope of the two neighbouring nodes:
//            exact for a piece of beam without shear that carries no load; at a node the node's.
// Thread     any; allocates. Failure: std::invalid_argument beyond the ends of the shaft.

#include <vector>

#include "plant_sim/rotor/finite_element.hpp"

namespace levitas::rotor {

/// Deflection of every mode at z, per unit modal coordinate.
[[nodiscard]] std::vector<double> DeflectionAt(const ModalRotor& rotor, double z_m);
/// Second derivative of the same [1/m]; at a node that of the piece towards the drive end.
[[nodiscard]] std::vector<double> CurvatureAt(const ModalRotor& rotor, double z_m);

}  // namespace levitas::rotor

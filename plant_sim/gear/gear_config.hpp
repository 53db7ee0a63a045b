#pragma once
// Description of a gear pair: which shafts it couples, where, and how. SI units.
//
// Frame      run-out is a vector in the wheel, from x towards y when its angle is 0. A wheel that
//            turns backwards carries it backwards: eps exp(j (-w t + phase)).
// Load       the shafts are aligned under the static load: all displacements count from there.

#include <cstddef>
#include <string>
#include <vector>

#include "plant_sim/gear/mesh.hpp"

namespace levitas::gear {

struct Wheel {
  std::size_t shaft{};
  double z_m{};  ///< along its own shaft
  int teeth{};
  double base_radius_m{};  ///< couples the torsion of the shaft; 0 is allowed without torsion
  double runout_m{};       ///< of the pitch circle against the axis of the shaft
  double runout_phase_rad{};
  double eccentric_mass_kg{};  ///< mass that the run-out moves off the axis
};

/// What a mesh does beyond the linear model; all zero or empty: nothing.
struct Imperfection {
  double backlash_m{};  ///< whole gap along the line of action
  double friction{};
  std::vector<StiffnessHarmonic> variation;
  std::vector<ToothCrack> cracks;
};

struct GearPair {
  std::string name;
  Wheel driving;
  Wheel driven;
  double stiffness_n_per_m{};
  double damping_n_s_per_m{};
  double pressure_angle_rad{};
  Direction direction{Direction::kIsotropic};
  double driving_torque_n_m{};  ///< static; the load on the teeth is this over the base radius
  std::vector<Harmonic> transmission_error;
  Imperfection imperfection;
};

}  // namespace levitas::gear

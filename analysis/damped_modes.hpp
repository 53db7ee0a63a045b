#pragma once
// Natural modes of a rig whose shafts stand on supports of their own, magnets without current.
//
// Equation   eigenvalues s of the linear model's displacements and velocities at one speed;
//            frequency Im(s)/2 pi, damping ratio -Re(s)/|s|. docs/derivations.md (G16).
// Torsion    share of the mode's kinetic energy in the torsional coordinates.
// Whirl      share of forward whirl in the rest: 1 forward, 0 backward, 0.5 motion in one plane.
// Thread     any; allocates.

#include <vector>

#include "plant_sim/plant/plant_config.hpp"

namespace levitas::analysis {

struct DampedMode {
  double frequency_hz{};
  double damping_ratio{};
  double torsion_share{};
  double forward_share{};
};

struct DampedModesAtSpeed {
  double speed_rad_per_s{};       ///< of the first shaft
  std::vector<DampedMode> modes;  ///< oscillating, ascending frequency
};

[[nodiscard]] DampedModesAtSpeed DampedModes(const plant::PlantConfig& plant,
                                             double speed_rad_per_s);

}  // namespace levitas::analysis

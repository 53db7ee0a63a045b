#pragma once
// What a rig is before any control: rotor mass, free-free whirl frequencies over speed, and the
// two constants of every magnet.
//
// Equation   whirl: undamped full finite-element model, no reduction (rotor/finite_element.hpp);
//            ki = 4 k i0/s0^2, ks = 4 k i0^2/s0^3 at the design bias (docs/derivations.md).
// Thread     any.

#include <cstddef>
#include <string>
#include <vector>

#include "plant_sim/plant/plant_config.hpp"

namespace levitas::analysis {

struct BearingConstants {
  std::string name;
  double ki_n_per_a{};
  double ks_n_per_m{};  ///< positive: destabilising
};

struct WhirlAtSpeed {
  double speed_rad_per_s{};
  std::vector<double> backward_hz;  ///< magnitudes, ascending, flexible modes
  std::vector<double> forward_hz;
};

struct FreeModes {
  double rotor_mass_kg{};
  std::vector<BearingConstants> bearings;
  std::vector<WhirlAtSpeed> whirl;  ///< in the order of the speeds asked for
};

[[nodiscard]] FreeModes ComputeFreeModes(const plant::PlantConfig& plant,
                                         const std::vector<double>& speeds_rad_per_s,
                                         std::size_t modes);

}  // namespace levitas::analysis

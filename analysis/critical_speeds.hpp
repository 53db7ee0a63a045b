#pragma once
// Speeds at which a natural frequency of a rotor equals its rotation, or another order of it
// (crossings in a Campbell diagram).
//
// Equation   |Im s_k(W)| = r W for a natural mode s_k of the rotor at speed W and an order r. Modes
//            are followed from speed to speed by the nearest s; a change of sign of |Im s| - r W
//            between two of the given speeds is narrowed until the speed is known to 1e-9 of it.
// Orders     1x of the rotor; of several shafts 1x of each, in turns of the first, and the teeth
//            of each gear pair: unbalance, runout, and what the mesh excites.
// Free       magnets off: undamped free-free bending modes.
// Shafts     of a rig with several: damped modes; speed and sense of whirl are the first shaft's.
// Levitated  poles of the sampled loop, static load and delay included, with a damping ratio below
//            1/sqrt(2): better damped, a mode has no resonance. An unbalance excites these.
// Missed     what crosses twice between two neighbouring speeds.
// Thread     any; allocates. Failure: BadInput when the law's axes do not fit the plant's.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "controller/law/law_config.hpp"
#include "plant_sim/plant/plant_config.hpp"

namespace levitas::analysis {

/// A natural mode at one speed, as a Campbell diagram has it.
struct CampbellMode {
  double frequency_hz{};  ///< without sign
  double damping_ratio{};
  double forward_share{};  ///< [1] 1 forward whirl, 0 backward, 0.5 motion in one plane
  double torsion_share{};
};

struct CampbellSpeed {
  double speed_rad_per_s{};
  std::vector<CampbellMode> modes;
};

/// What excites a mode, so many times a turn.
struct Order {
  std::string name;  ///< "1x", "1x of pinion", "mesh"
  double per_turn{};
};

struct CriticalSpeed {
  double speed_rad_per_s{};
  CampbellMode mode;    ///< there
  std::size_t order{};  ///< of Campbell::orders
};

struct Campbell {
  std::vector<CampbellSpeed> speeds;  ///< evenly spaced from 0 to the top
  /// Of each speed but the last: which mode of the next speed a mode becomes; nothing: it ends.
  std::vector<std::vector<std::optional<std::size_t>>> next;
  std::vector<Order> orders{{"1x", 1.0}};
  std::vector<CriticalSpeed> crossings;  ///< of the orders, ascending
};

using ModesAt = std::function<std::vector<CampbellMode>(double speed_rad_per_s)>;

/// See above.
[[nodiscard]] std::vector<Order> OrdersOf(const plant::PlantConfig& plant);

/// Modes at `steps` + 1 speeds from 0 to `top_rad_per_s`, and where they cross the orders.
[[nodiscard]] Campbell CampbellOf(const ModesAt& modes, double top_rad_per_s, int steps,
                                  const std::vector<Order>& orders = {{"1x", 1.0}});

/// The first `modes` bending modes of the free rotor, or of the shafts; see above.
[[nodiscard]] Campbell FreeCampbell(const plant::PlantConfig& plant, double top_rad_per_s,
                                    std::size_t modes);

/// Poles of the loop that resonate, at any speed. Both have to outlive it.
[[nodiscard]] ModesAt LevitatedModes(const plant::PlantConfig& plant, const law::LawConfig& law);
[[nodiscard]] Campbell LevitatedCampbell(const plant::PlantConfig& plant, const law::LawConfig& law,
                                         double top_rad_per_s);

/// 1/(2 zeta): how much larger an unbalance makes the orbit in the resonance than far above it.
/// API 617 calls a critical speed with less than kCriticallyDamped critically damped: nothing has
/// to keep away from it.
[[nodiscard]] double AmplificationFactor(const CampbellMode& mode);
inline constexpr double kCriticallyDamped = 2.5;

/// "forward", "backward", or "plane" where neither leads; "torsion".
[[nodiscard]] const char* WhirlName(const CampbellMode& mode);

}  // namespace levitas::analysis

#pragma once
// A robust H-infinity controller for a rig, as the law that the controller program runs.
//
// Method     plane by plane at rest (plane_plant.hpp), Riccati synthesis a few per cent above the
//            smallest gamma, balanced truncation, Tustin, blocks of one or two states. The speed
//            range is covered by the perturbations of the modes.
// Not proven here  the speed range, saturation, the static load, mu: design/gate judges the law.
// Units      SI. Thread: any; pure; a fraction of a second for two magnets.
// Failure    BadInput: a weight. Problem: a plant without a controller (synthesis/plant_rank.hpp),
//            or a law with a pole that does not decay: it winds up at the current limit, and lifts
//            of the rotor fail.

#include "controller/law/law_config.hpp"
#include "design/hinf/hinf_weights.hpp"
#include "plant_sim/plant/plant_config.hpp"

namespace levitas::hinf {

struct HinfDesignOptions {
  double current_limit_a{};
  double top_speed_rad_per_s{};  ///< sizes the force at the disc
  std::size_t most_states{48};   ///< of the law, all axes together
};

struct HinfDesign {
  law::LawConfig law;  ///< state space, discrete
  double gamma{};      ///< at which the worst plane's controller was formed
  std::size_t full_states{};
  std::size_t states{};
  double slowest_pole_1_per_s{};  ///< decay rate of the law's slowest state; <= 0: it grows
};

/// The law, stable or not.
[[nodiscard]] HinfDesign MakeLaw(const plant::PlantConfig& rig, const HinfWeights& weights,
                                 const HinfDesignOptions& options);

/// The same, a law that does not decay refused, the plant's conditions checked first.
[[nodiscard]] HinfDesign DesignHinf(const plant::PlantConfig& rig, const HinfWeights& weights,
                                    const HinfDesignOptions& options);

}  // namespace levitas::hinf

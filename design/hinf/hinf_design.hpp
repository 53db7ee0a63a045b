#pragma once
// A robust H-infinity controller for a rig, as the law that the controller program runs.
//
// Method     generalised_plant.hpp, D-K iteration with constant scalings (so that the controller
//            does not grow), balanced truncation to the states a law may have, Tustin, blocks of
//            one or two states.
// Not proven here  the speed range, saturation, and the static load: the design is linear, at one
//            speed. Judge the law by the rig's own sampled loop (analysis/sensitivity.hpp) and by
//            campaigns on the nonlinear plant before it is used.
// Units      SI. Thread: any; pure; seconds to tens of seconds.
// Failure    Problem: a weight (generalised_plant.hpp), a plant without a controller
//            (synthesis/plant_rank.hpp), or a reduction that would lose stability or mu.

#include "controller/law/law_config.hpp"
#include "design/hinf/hinf_weights.hpp"
#include "design/synthesis/dk_iteration.hpp"
#include "plant_sim/plant/plant_config.hpp"

namespace levitas::hinf {

struct HinfDesignOptions {
  double speed_rad_per_s{};  ///< of the linear model: the middle of the range splits modes least
  int turns{3};              ///< of the D-K iteration
  double allowed_loss{0.1};  ///< share of mu that the reduction may cost
};

struct HinfDesign {
  law::LawConfig law;  ///< state space, discrete
  double mu{};         ///< proven peak of the reduced controller's loop, weights included
  Eigen::Index states{};
  std::vector<synthesis::DkTurn> turns;
};

[[nodiscard]] HinfDesign DesignHinf(const plant::PlantConfig& rig, double current_limit_a,
                                    const HinfWeights& weights, const HinfDesignOptions& options);

}  // namespace levitas::hinf

#pragma once
// H-infinity controller of a continuous plant by two Riccati equations.
//
// Equation   K stabilises P and ||F_l(P, K)||_inf < gamma exists exactly when gamma exceeds the
//            norms of D11's reachable parts, both Riccati equations have solutions X >= 0, Y >= 0,
//            and the spectral radius of X Y is below gamma^2. K is the central controller.
// Source     K. Glover, J. C. Doyle, Systems & Control Letters 11 (1988) 167; formulas of K. Zhou,
//            J. C. Doyle, K. Glover, Robust and Optimal Control, 1996, theorem 17.1 (D11 of any
//            size; D12, D21 brought to [0; I] and [0 I] by singular values; D22 by a loop shift).
// Accepted   only a controller whose closed loop, formed from the given plant, has stable poles and
//            a norm (hinf_norm.hpp, other equations) at most gamma: Riccati solvers report success
//            for loops that are not. When the check refuses, gamma is raised in steps and tried
//            again.
// Units      inputs and outputs must be of like size (see state_space.hpp).
// Failure    Problem: a condition of plant_rank.hpp, or no gamma below `largest_gamma`, or no
//            controller that passes the check.
// Thread     any; pure.

#include <optional>
#include <string>

#include "design/synthesis/plant_rank.hpp"
#include "design/synthesis/state_space.hpp"

namespace levitas::synthesis {

struct HinfOptions {
  double tolerance{1e-3};  ///< relative width at which the search for gamma ends
  /// The controller is formed at this multiple of the smallest gamma found. At 1 it has poles far
  /// beyond the plant's, since I - X Y / gamma^2 becomes singular there.
  double relaxation{1.002};
  double largest_gamma{1e8};
  double first_gamma{1.0};  ///< where the search starts
};

struct HinfController {
  StateSpace controller;  ///< y -> u, u = K y: as many states as the plant
  double gamma{};         ///< upper bound of the closed loop's norm, from the check
  double limit{};  ///< below this no controller exists (Riccati conditions), within tolerance
};

/// Smallest gamma and its controller.
[[nodiscard]] HinfController Synthesise(const GeneralisedPlant& plant,
                                        const HinfOptions& options = {});

/// The central controller at one gamma, not checked; nothing when the conditions fail, and then
/// `reason` (if given) says which.
[[nodiscard]] std::optional<StateSpace> CentralController(const GeneralisedPlant& plant,
                                                          double gamma,
                                                          std::string* reason = nullptr);

}  // namespace levitas::synthesis

#pragma once
// The generalised plant of a synthesis, and the conditions under which a controller exists at all.
//
// Equation   dx/dt = A x + B1 w + B2 u,  z = C1 x + D11 w + D12 u,  y = C2 x + D21 w + D22 u
// Conditions (A, B2) stabilisable, (C2, A) detectable; D12 of full column rank (every control is
//            penalised), D21 of full row rank (every measurement carries noise); no zero of
//            (A, B2, C1, D12) and (A, B1, C2, D21) on the imaginary axis.
// Source     K. Zhou, J. C. Doyle, K. Glover, Robust and Optimal Control, 1996, section 17.1.
// Failure    Problem whose text names the condition and the mode or channel that breaks it.
// Thread     any; pure.

#include "design/synthesis/state_space.hpp"

namespace levitas::synthesis {

/// The last `controls` inputs are u, the last `measurements` outputs are y.
struct GeneralisedPlant {
  StateSpace system;
  Eigen::Index controls{};
  Eigen::Index measurements{};
  [[nodiscard]] Eigen::Index disturbances() const noexcept { return system.inputs() - controls; }
  [[nodiscard]] Eigen::Index errors() const noexcept { return system.outputs() - measurements; }
};

void CheckSolvable(const GeneralisedPlant& plant);

}  // namespace levitas::synthesis

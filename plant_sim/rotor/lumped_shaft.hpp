#pragma once
// One rigid disc on an elastic shaft, in modal coordinates; and the stiffness of a simply supported
// beam with a disc somewhere between its ends.
//
// Equation   flexibility at z = a of a beam of span L = a + b (Timoshenko & Young, beam tables):
//              ayy = a^2 b^2/(3 EI L), aya = a b (b - a)/(3 EI L), aaa = (a^2 - a b + b^2)/(3 EI L)
//            docs/derivations.md (G8)-(G10).
// Thread     any; allocates. Failure: std::invalid_argument naming the number.

#include "plant_sim/rotor/finite_element.hpp"
#include "plant_sim/rotor/shaft_config.hpp"

namespace levitas::rotor {

/// Sets kll, kla and kaa of a disc at `a_m` of a simply supported beam, and `tilts`.
void SetSimplySupported(LumpedShaft& shaft, double span_m, double bending_stiffness_n_m2);

/// The same shaft without its tilt: psi = td r with td = -kla/kaa (static condensation); the tilt's
/// inertia becomes mass, its gyroscopic moment is lost.
[[nodiscard]] LumpedShaft CondenseTilt(const LumpedShaft& shaft);

/// Undamped modes of the shaft, one or two; damping_n_s_per_m is left to a support at its plane.
[[nodiscard]] ModalRotor Reduce(const LumpedShaft& shaft);

}  // namespace levitas::rotor

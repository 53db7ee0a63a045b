#pragma once
// All lines and all unknowns of a geared rotor at once, from where the two linear steps ended.
//
// Equation  both shafts' equations of full_spectrum.hpp hold for the true lines z: E(x, z) = 0,
//           affine in z. With noise of covariance V on z, and z itself unknown, the likelihood is
//           greatest where  sum E' W^-1 E + sum (correction/uncertainty)^2  is least, E of the
//           measured lines, W = A V A', A = dE/dz (errors in variables; Golub & Van Loan 1980 for
//           one equation). Gauss-Newton, dE/dx taken at the lines as they are best explained:
//           z - V A' W^-1 E; taken at the measured ones it would draw every unknown towards 0.
// Unknowns  ks, ki, run-outs, mesh, every transmission error; with `uncertainty` a correction of
//           every known number of the shafts and of each torsional mode's frequency and twist,
//           held by it, and ks/ki of the magnets held to i0/s0 by it.
// Errors    (J'J + 1/prior^2)^-1, times chi^2 where the lines depart by more than their noise.
// Thread    any. Failure: none; a step that does not improve is not taken.

#include <vector>

#include "identification/geared/full_spectrum.hpp"

namespace levitas::identification {

/// `p` from the linear steps; lines without noise count as good to 1e-4 of the rms.
void FitJointly(const std::vector<GearedLine>& lines, const GearedKnown& known,
                GearedParameters& p);

}  // namespace levitas::identification

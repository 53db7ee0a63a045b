#pragma once
// A correction split onto holes that are given.
//
// Equation   m_a e^{j a} + m_b e^{j b} = m e^{j phi} between the neighbours a <= phi < b:
//            m_a = m sin(b - phi)/sin(b - a), m_b = m sin(phi - a)/sin(b - a). Where a hole would
//            hold more than it may, the least squares over all holes within their limits, with as
//            little mass as that takes.
// Smallest   a weight below what a hole can have is left out or made the smallest, whichever comes
//            closer to the correction.
// Drill      the same with the direction turned by half a turn: mass is taken where it is too much.
// Units      SI; moments kg m, complex as balance_rig.hpp says. Thread: any; pure.

#include <complex>
#include <vector>

#include "identification/balance/planes.hpp"

namespace levitas::balancing {

struct Weight {
  std::size_t hole{};  ///< 1 is the first; 0: at any angle
  double angle_rad{};
  double mass_kg{};  ///< added, or taken away
};

struct PlacedWeights {
  std::vector<Weight> weights;
  std::complex<double> moment_kg_m;  ///< added unbalance that they are
};

/// `added_kg_m`: the unbalance to be added. The plane has a radius.
[[nodiscard]] PlacedWeights PlaceWeights(std::complex<double> added_kg_m,
                                         const CorrectionPlane& plane, bool drill);

}  // namespace levitas::balancing

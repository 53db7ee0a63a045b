#pragma once
// A generalised plant without what keeps the two Riccati equations from having a solution: controls
// that no error weighs, measurements without noise.
//
// Equation   z' = (z, weight u),  w' = (w, n),  y' = y + weight n: D12 and D21 of z' and w' have
//            full rank. F_l(P, K) is a block of F_l(P', K), so its norm is at most the gamma of P';
//            as the weight falls, gamma tends to the smallest one of P, which no proper controller
//            may reach (K. Zhou, J. C. Doyle, K. Glover, Robust and Optimal Control, 1996, section
//            17.1).
// Use        explicit: a synthesis refuses such a plant, since a controller for it has gains and
//            bandwidths that its problem does not limit.
// Not cured  modes that cannot be reached or seen, and zeros on the imaginary axis within D's rank.
// Failure    std::invalid_argument for a weight that is not above zero.
// Thread     any; pure.

#include "design/synthesis/plant_rank.hpp"

namespace levitas::synthesis {

[[nodiscard]] GeneralisedPlant Regularised(const GeneralisedPlant& plant, double weight);

}  // namespace levitas::synthesis

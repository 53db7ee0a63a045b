#pragma once
// Effective ki and ks in an experiment, with the magnets' nonlinearity, from its record.
//
// Equation  F = k [((i0+i)/(s0-x))^2 - ((i0-i)/(s0+x))^2]; the best linear model of jointly
//           Gaussian i and x has the means of its slopes (Bussgang 1952). To the second order, with
//           a = i/i0 and e = x/s0:
//             E dF/di = ki (1 + 3 E e^2 + 2 E a e),   E dF/dx = ks (1 + E a^2 + 6 E e^2 + 6 E a e);
//           the next order is below 1e-3 for a third of the bias and a tenth of the gap.
// About     the static working point: load and a centre that the probes do not show are in the ki
//           and ks that are found.
// Inputs    moments of the recorded currents, through the amplifier, and positions about their
//           means (frf/frequency_response.hpp); bias and gap of the rig file.
// Result    factors, axes x experiments; the excited axis is the stiffest.
// Thread    any.

#include "identification/frf/frequency_response.hpp"
#include "identification/modal/modal_response.hpp"

namespace levitas::identification {

[[nodiscard]] WorkingGains WorkingGainsOf(const ModalFrame& frame,
                                          const FrequencyResponse& response);

}  // namespace levitas::identification

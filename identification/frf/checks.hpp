#pragma once
// Refuses records from which a model would come out wrong with confidence: each defect one
// sentence that names the channel and says what to do.
//
// Dead      a position that takes fewer than four values, or that moves only by a converter step.
// Clipped   more than 1 in 1000 positions at the sensor's range, or 2 % of the currents at the
//           coils' limit (a limited command is known, so it does less harm); or 5 in 1000 positions
//           on a flat top below the range (flat_top.hpp).
// Sign      S = 1 above the loop's bandwidth (a current that follows its excitation with the wrong
//           sign gives -1); the plant pushes: below the first bending mode a free rotor moves
//           against the force, P ~ -ki/(m w^2), so Re P < 0 on the axis' own channel.
// Failure   BadInput listing every defect found.
// Thread    any.

#include "identification/frf/experiments.hpp"
#include "identification/frf/frequency_response.hpp"

namespace levitas::identification {

void RefuseBadSignals(const session::Recording& record, const std::vector<Experiment>& experiments);
/// `delay_s`: from sample to acting current, the rig's; its phase is taken out first.
void RefuseWrongSigns(const FrequencyResponse& response, double delay_s);

}  // namespace levitas::identification

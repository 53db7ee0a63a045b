#pragma once
// The sampling instants of batches of measured torsion, one after the other.
//
// Thread   any. Failure: none; a batch of another number of couplings is of another rig, and is
//          left out.

#include <cstdint>
#include <span>
#include <vector>

#include "common/torsion_batch.hpp"

namespace levitas::session {

/// visit(rig_session, cycle, torque [N m] per coupling, twist [rad] per coupling).
template <class Visit>
void ForEachInstant(const std::vector<TorsionBatch>& batches, std::size_t couplings,
                    const Visit& visit) {
  for (const TorsionBatch& batch : batches) {
    if (batch.couplings != couplings) continue;
    for (std::uint32_t s = 0; s < batch.samples; ++s) {
      const std::size_t at = s * couplings;
      visit(batch.rig_session, batch.first_cycle + s,
            std::span(batch.torque_n_m).subspan(at, couplings),
            std::span(batch.twist_rad).subspan(at, couplings));
    }
  }
}

}  // namespace levitas::session

#pragma once
// Evaluation zones of magnetic bearings: vibration as a fraction of the clearance.
//
// Vibration  largest displacement of the shaft from the clearance centre over the minimum radial
//            clearance: A below 0.3, B below 0.4, C below 0.5, D from there (after ISO 14839-2).
//            The zones of the sensitivity peak (ISO 14839-3) are those of analysis/sensitivity.hpp.
// Border     a value exactly on a border belongs to the worse zone.
// Meaning    A: newly commissioned machines. B: fit for long-term operation. C: only until there
//            is an occasion to put it right. D: able to cause damage.
// Failure    a value that is not a number is D, never A.

#include "analysis/sensitivity.hpp"

namespace levitas::verdict {

using analysis::Zone;

/// `displacement_over_clearance` [1] is counted from the clearance centre, offset included.
[[nodiscard]] constexpr Zone ClearanceZone(double displacement_over_clearance) noexcept {
  if (displacement_over_clearance < 0.3) return Zone::kA;
  if (displacement_over_clearance < 0.4) return Zone::kB;
  return displacement_over_clearance < 0.5 ? Zone::kC : Zone::kD;
}

[[nodiscard]] constexpr char Letter(Zone zone) noexcept {
  return static_cast<char>('A' + static_cast<int>(zone));
}

/// Zones in which a machine may be handed over.
[[nodiscard]] constexpr bool Acceptable(Zone zone) noexcept {
  return zone == Zone::kA || zone == Zone::kB;
}

}  // namespace levitas::verdict

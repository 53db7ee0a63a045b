#pragma once
// The piece of a shaft at a place.
//
// Frame    z from the drive end, as in rotor_config.hpp. A place where two pieces meet belongs to
//          the later one; beyond the end it is the last piece.
// Thread   any; pure. Failure: none; `sections` is not empty (CheckShaft).

#include "plant_sim/rotor/rotor_config.hpp"

namespace levitas::rotor {

[[nodiscard]] inline const Section& SectionAt(const RotorConfig& config, double z_m) {
  double end = 0.0;
  for (const auto& section : config.sections) {
    end += section.length_m;
    if (z_m < end) return section;
  }
  return config.sections.back();
}

}  // namespace levitas::rotor

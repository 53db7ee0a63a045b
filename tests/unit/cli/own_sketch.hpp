#pragma once
// A rotor as `amb new rig` is told of one: 8 kg on 600 mm, 12 000 rpm.

#include "cli/new_rig/rig_sketch.hpp"

namespace levitas::cli {

[[nodiscard]] inline RigSketch Sketch() {
  return {.name = "own",
          .mass_kg = 8.0,
          .length_mm = 600.0,
          .max_speed_rpm = 12'000.0,
          .ki_n_per_a = 60.0,
          .gap_mm = 0.4,
          .bias_a = 2.0,
          .bearings_mm = {},
          .discs = {}};
}

}  // namespace levitas::cli

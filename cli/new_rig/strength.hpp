#pragma once
// What the magnets of a sketch can do: whether its rig file can hold them, and whether they can
// carry the rotor. Said of the options that were given, before any file is made of them.
//
// Failure  BadInput with option, found, allowed and what helps.
// Thread   any; pure.

#include "cli/new_rig/rig_sketch.hpp"

namespace levitas::cli {

/// Of a magnet that no rig file can hold: its ki, or its force constant ki gap^2 / (4 bias).
/// `option` is what gave the strength: --ki-n-per-a, --ks-n-per-m or --turns with --pole-area-mm2.
void RefuseStrength(const RigSketch& sketch, const std::string& option);

/// Of a shaft whose diameter follows from its mass and is none.
void RefuseDiameter(const RigSketch& sketch, const SketchNumbers& numbers);

/// Of a rotor that no law can lift.
void RefuseOverload(const RigSketch& sketch, const SketchNumbers& numbers);

/// What each magnet carries of the weight, and whether it can well: a line for each.
[[nodiscard]] std::string LoadsText(const RigSketch& sketch, const SketchNumbers& numbers);

}  // namespace levitas::cli

#pragma once
// The law that a new rig starts with: of a small table of forms that are stable at rest and at top
// speed the one with the smallest peak of |S| at rest; the usual form where none is stable. A
// start, not a design: no uncertainty, no noise, no orbit.
//
// Forms     stiffness over the magnet's, damping, a lead in front, notches at the first two bending
//           modes or a little below (which turns their phase forward); 168 in all.
// Cost      some seconds. Thread: any. Failure: as analysis::ClosedLoopPoles.

#include "cli/new_rig/rig_sketch.hpp"
#include "configuration/rig_file.hpp"

namespace levitas::cli {

/// `rig` is that of the sketch.
[[nodiscard]] StartLaw ChooseStartLaw(const RigSketch& sketch, const configuration::RigFile& rig);

}  // namespace levitas::cli

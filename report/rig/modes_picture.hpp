#pragma once
// Picture of a rig before any control: Campbell diagram of the free rotor, and its mode shapes on
// the shaft with centre of mass, moments of inertia and the static load of every bearing.
//
// Shaft    sections and rings to scale along z; diameters to one scale of their own, discs that the
//          file gives without a diameter as thin bars. A rotor known by its modes alone is a line.
// Several  shafts: the Campbell diagram of their damped modes alone, over the speed of the first.
// Thread   any; pure.

#include <optional>

#include "analysis/critical_speeds.hpp"
#include "analysis/rotor_figures.hpp"
#include "configuration/rig_file.hpp"
#include "report/svg/figure.hpp"

namespace levitas::report {

/// `figures` is empty for a rig of several shafts.
[[nodiscard]] svg::Figure ModesPicture(const configuration::RigFile& rig,
                                       const analysis::Campbell& campbell,
                                       const std::optional<analysis::RotorFigures>& figures);

}  // namespace levitas::report

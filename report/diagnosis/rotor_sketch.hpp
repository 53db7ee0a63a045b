#pragma once
// The rotor of a diagnosis drawn along the shaft, with magnets, sensors and the places of causes.
//
// Scale    the same along and across, unless the rotor is too thick for the picture: then it is
//          compressed across.
// Marks    an arrow onto the shaft's surface and a text above it, one row each.
// Empty    text where there is no rotor to draw.
// Thread   any; pure.

#include <string>
#include <vector>

#include "diagnosis/report/diagnosis_report.hpp"

namespace levitas::report {

/// One SVG element; names are shown as text whatever they hold. `marks`: the text of each mark.
[[nodiscard]] std::string RotorSketch(const diagnosis::DiagnosisReport& report,
                                      const std::vector<std::string>& marks);

}  // namespace levitas::report

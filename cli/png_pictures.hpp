#pragma once
// SVG files as PNG beside them, by the program rsvg-convert (Debian package librsvg2-bin). It is
// started, not linked: its library is LGPL-2.1, and SVG alone is enough where it is missing.
//
// Thread   any; waits for each picture, a minute at most.
// Failure  Problem (exit status 1) when the program is there and fails, with what it said.

#include <string>
#include <vector>

namespace levitas::cli {

/// "/usr/bin/rsvg-convert"; empty when it is nowhere on the PATH.
[[nodiscard]] std::string FindSvgConverter();

/// NAME.svg of the folder becomes NAME.png, twice as many pixels as the drawing's units.
void WritePngs(const std::string& converter, const std::string& folder,
               const std::vector<std::string>& names);

}  // namespace levitas::cli

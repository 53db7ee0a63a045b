#pragma once
// The layout as a DBC file, which other CAN tools read (cantools, SavvyCAN, PlotJuggler,
// CANalyzer).
//
// Units   SI, as everywhere; a signed signal at its most negative raw value is "absent".
// Thread  any. Failure: none.

#include <string>

#include "hil/can/layout.hpp"

namespace levitas::can {

[[nodiscard]] std::string DbcText(const Layout& layout);

/// The same table for people, in Markdown.
[[nodiscard]] std::string LayoutMarkdown(const Layout& layout);

}  // namespace levitas::can

#pragma once
// What an engineer should know of a law's own dynamics before it runs: poles that do not decay.
//
// Integrator   a real pole at z = 1 (s = 0).
// Unstable     any other pole on or outside the unit circle (on or right of the imaginary axis):
//              the law alone grows, and only the loop around it holds it. Allowed where the
//              currents show it and the sensors reach it (controller/law/hidden_states.hpp); others
//              are refused when the file is read.
// Thread       any. Failure: none.

#include <string>
#include <vector>

#include "controller/law/law_config.hpp"

namespace levitas::configuration {

/// One sentence per unstable block, and one for all integrators; empty for a law that decays.
[[nodiscard]] std::vector<std::string> LawNotes(const law::LawConfig& law);

}  // namespace levitas::configuration

#pragma once
// After how many samples a test signal repeats: read off the signal itself, so that a recorded
// session and a file from elsewhere are treated alike.
//
// Equation  smallest N with e[n] = e[n - N] for every n >= N of the piece, to 1e-6 of the largest
//           value (a CSV file rounds).
// Thread    any.

#include <cstddef>
#include <optional>
#include <span>

namespace levitas::identification {

/// Nothing when the piece does not repeat itself at least once, whole.
[[nodiscard]] std::optional<std::size_t> RepeatsAfter(std::span<const double> signal);

}  // namespace levitas::identification

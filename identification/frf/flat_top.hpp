#pragma once
// Whether a signal is cut off below the range that its sensor is said to have: by an amplifier, a
// filter, a converter with another range.
//
// Sign      its largest or its smallest value stands more than five times as often as the one next
//           to it. Noise leaves fewer there, and a sine on a coarse converter 2.4 times as many
//           (1/(sqrt(2) - 1)).
// Thread    any, pure.

#include <span>

namespace levitas::identification {

/// Share of the samples on a flat top or bottom; 0 without one.
[[nodiscard]] double FlatShare(std::span<const double> values);

}  // namespace levitas::identification

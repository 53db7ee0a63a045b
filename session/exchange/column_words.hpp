#pragma once
// What the name of a measured column says to somebody who knows bearings: its dimension, which axis
// it is of, whether it is a test signal. Used to guess a map of columns (column_guess.hpp).
//
// Words      split at everything but letters and digits, at capitals inside a word, and between
//            letters and digits; short ones into letters: "IXA" is current, x, first bearing.
// Bearings   by the rig's own names, else by their order: A, 1, left, front, upper, DE are the
//            first, B, 2, right, rear, lower, NDE the second.
// Thread     any. Failure: none; what is not understood is left out.

#include <cstdint>
#include <optional>
#include <string>

#include "common/rig_numbers.hpp"

namespace levitas::session {

enum class Dimension : std::uint8_t { kNone, kTime, kAngle, kSpeed, kLength, kCurrent };

/// An angle beyond so many turns is rather counted in degrees.
inline constexpr double kMostTurns = 1.0;

struct NameMeaning {
  Dimension dimension{};
  std::string unit;                 ///< as maps have it; empty: not said
  std::optional<std::size_t> axis;  ///< of the rig
  bool excitation{};
  bool gap{};
};

/// `unit` is that of a row of units, or empty.
[[nodiscard]] NameMeaning MeaningOf(const std::string& name, const std::string& unit,
                                    const RigNumbers& rig);

}  // namespace levitas::session

#pragma once
// Which rows of a record hold a test signal, and on which axes.
// Thread  any; pure.

#include <cstddef>

#include "session/exchange/recording.hpp"

namespace levitas::analysis {

[[nodiscard]] inline bool ExcitedAt(const session::Recording& recording, std::size_t axis,
                                    std::size_t row) {
  return recording.ExcitationOf(axis, row) != 0.0 ||
         recording.PositionExcitationOf(axis, row) != 0.0;
}

/// On any axis.
[[nodiscard]] inline bool ExcitedAt(const session::Recording& recording, std::size_t row) {
  for (std::size_t axis = 0; axis < recording.axes(); ++axis) {
    if (ExcitedAt(recording, axis, row)) return true;
  }
  return false;
}

}  // namespace levitas::analysis

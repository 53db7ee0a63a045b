#pragma once
// Compares the outputs of two control cycles bit for bit and names the first field that differs.
//
// Bits   NaN equals the same NaN and 0 differs from -0: what is compared is the arithmetic, not the
//        values.

#include <optional>
#include <string>
#include <vector>

#include "controller/cycle/cycle_io.hpp"

namespace levitas::session {

struct OutputDifference {
  std::string field;     ///< "control_current_a de_x"
  std::string recorded;  ///< as text with all digits
  std::string computed;
};

[[nodiscard]] std::optional<OutputDifference> FirstDifference(
    const cycle::CycleOutputs& recorded, const cycle::CycleOutputs& computed,
    const std::vector<std::string>& channels);

}  // namespace levitas::session

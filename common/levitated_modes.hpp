#pragma once
// The modes in which the rotor is held free of its touchdown bearings: levitating, spinning,
// coast_down. In all others (off, self-test, lift, landing, tripped) it lies there, or is moved on
// purpose.

#include "common/enums.hpp"

namespace levitas {

[[nodiscard]] constexpr bool IsLevitated(Mode mode) noexcept {
  return mode == Mode::kLevitating || mode == Mode::kSpinning || mode == Mode::kCoastDown;
}

}  // namespace levitas

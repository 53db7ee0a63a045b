#pragma once
// One turn in radians, and the factor from a frequency in hertz to one in radians per second.

#include <numbers>

namespace levitas {

inline constexpr double kTwoPi = 2.0 * std::numbers::pi;

}  // namespace levitas

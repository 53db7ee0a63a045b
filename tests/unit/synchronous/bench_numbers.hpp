#pragma once
// Numbers that the tests of synchronous control share.

#include <numbers>

namespace levitas::synchronous {

inline constexpr double kPeriodS = 1e-4;
inline constexpr double kTurn = 2.0 * std::numbers::pi;

}  // namespace levitas::synchronous

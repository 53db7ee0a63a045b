#pragma once
// Constants of the normal distribution.
// Thread   any; constants.

namespace levitas::numerics {

/// Standard deviations from the mean to either end of the interval that holds 90 % (5 to 95 %):
/// the inverse of the cumulative distribution at 0.95, 1.6449, rounded as tables print it.
inline constexpr double kInterval90 = 1.645;

}  // namespace levitas::numerics

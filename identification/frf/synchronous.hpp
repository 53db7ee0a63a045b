#pragma once
// Takes what turns with the rotor out of a signal: unbalance and run-out do not repeat with the
// test signal and would leak into all its lines.
//
// Equation  least squares of  mean + sum_k (a_k cos k theta + b_k sin k theta), k = 1 .. orders,
//           over the rows given, theta the recorded angle. Subtracts it, the mean included.
// Thread    any.

#include <span>
#include <vector>

namespace levitas::identification {

/// `angle_rad` and `signal` have the same length. With `orders` 0 only the mean is removed. A test
/// sine of `cycles_per_sample` (0: none) is fitted beside and stays.
[[nodiscard]] std::vector<double> WithoutSynchronous(std::span<const double> signal,
                                                     std::span<const double> angle_rad, int orders,
                                                     double cycles_per_sample = 0.0);

}  // namespace levitas::identification

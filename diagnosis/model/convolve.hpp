#pragma once
// A finite impulse response over contiguous values: the whitening of innovations and their slopes.
//
// Equation   to[n] = sum over k of filter[k] now[n - k], k ascending, n < count. The values before
//            `now`, one fewer than the filter has, must exist.
// Cost       4 products per clock cycle with AVX2, half of that without; chosen at start-up. Both
//            ways round alike: no contraction (cmake/Compiler.cmake).
// Thread     any.

#include <cstddef>
#include <vector>

namespace levitas::diagnosis {

void Convolve(const std::vector<double>& filter, const double* now, std::size_t count,
              double* to) noexcept;

}  // namespace levitas::diagnosis

#pragma once
// The imaginary unit of the equations at a line of the spectrum, e^(j w t).

#include <complex>

namespace levitas::identification {

inline constexpr std::complex<double> kJ{0.0, 1.0};

}  // namespace levitas::identification

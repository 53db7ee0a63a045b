#pragma once
// What turns with the rotor once per revolution, of each axis, in the newest samples.
//
//   x(n) = |X| cos(theta_n + arg X)      X = 2/N sum (x(n) - mean) exp(-i theta_n)
//
// over N samples that are whole turns of the key phasor's angle theta, two at least. The angle is
// measured, so a speed that changes meanwhile smears nothing.
//
// Units    metres, radians; a positive phase leads the key phasor. Thread any; allocates.
// Failure  nothing while the rotor does not turn two whole turns within kSpectrumLength
//          uninterrupted samples, or a reading is no number.

#include <complex>
#include <optional>
#include <vector>

#include "dashboard/sample_store.hpp"

namespace levitas::dashboard {

/// One of each axis.
[[nodiscard]] std::optional<std::vector<std::complex<double>>> FirstOrderOf(
    const SampleStore& store);

}  // namespace levitas::dashboard

#pragma once
// Modes that stand out of a response by their shape over frequency, however weak: what a rational
// fit of everything at once does not hold on to.
//
// Equation  about a frequency f every entry of P is c_0 + c_1 x + c_2 x^2 + r/(f^2 - g^2 + 2 j z f
//           g) over the lines g, x = (g - f)/width, with complex c and r of its own: linear least
//           squares in units of the noise, a matched filter. F is the reduction of the sum of
//           squares by r, per entry, over the residual variance: 1 with noise alone.
// Mode      F beyond kClear, largest within its surroundings, with the modes found before in the
//           place of c where they are near; damping from a list, so it is coarse.
// Thread    any; some tenths of a second.

#include <vector>

#include "identification/frf/frequency_response.hpp"

namespace levitas::identification {

/// Nearer than this share of its frequency, two findings are one mode.
inline constexpr double kSameMode = 0.015;

struct ScannedMode {
  double frequency_hz{};
  double damping_ratio{};
  double evidence{};  ///< F
};

/// Ascending. Entries within a plane only.
[[nodiscard]] std::vector<ScannedMode> ScanModes(const FrequencyResponse& response,
                                                 double lowest_hz, double highest_hz);

}  // namespace levitas::identification

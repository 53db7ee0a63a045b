#pragma once
// |S_ii| of a measured frequency response with the help of the lines beside each line: the largest
// of many noisy lines is too high by what the noise adds there.
//
// Equation   on the lines k - h to k + h a parabola a + b f + c f^2, complex, is fitted with the
//            weights 1/var S_ii; S^ = a at line k, var S^ from the same normal equations.
//            h grows through 2, 3, 5, 8, 12, 18 as long as the new value is no farther from each
//            narrower one than noise moves it: |S^_h - S^_g|^2 <= 4 (var S^_g - var S^_h), g < h
//            (Lepski's rule; the two variances subtract because the fits are nested, and noise
//            alone exceeds it with the chance e^-4). A peak narrower than five lines keeps its own
//            line.
//            Size: sqrt(|S^|^2 - var S^), since E|S^|^2 = |S|^2 + var S^.
// Not done   what the largest of the smoothed lines still adds: a third of sigma to one sigma.
// Thread     any. Failure: none.

#include <vector>

#include "identification/frf/frequency_response.hpp"

namespace levitas::identification {

struct SmoothedLine {
  double size{};        ///< |S_ii| without the noise's share [1]
  double sigma{};       ///< standard deviation of the complex S^ [1]
  std::size_t lines{};  ///< over which it was fitted; 1: the line alone
};

/// One per line of the response.
[[nodiscard]] std::vector<SmoothedLine> SmoothedSensitivity(const FrequencyResponse& response,
                                                            Eigen::Index axis);

}  // namespace levitas::identification

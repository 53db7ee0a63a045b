#pragma once
// Full spectrum of an orbit over orders of rotation, as a curve of a picture.
//
// Orbit    numbers x + jy, evenly over whole turns.
// Curve    amplitude of each line times `unit`, 1e6 for um of m; positive orders turn forward. No
//          window: the lines of whole turns fall on the bins.
// Thread   any; pure.

#include <complex>
#include <string>
#include <vector>

#include "report/svg/figure.hpp"

namespace levitas::signature {

struct Orders {
  int turns{};  ///< that the orbit covers
  int most{};   ///< orders drawn either way
  double unit{1e6};
};

/// a - b, number by number.
[[nodiscard]] std::vector<std::complex<double>> Difference(
    const std::vector<std::complex<double>>& a, const std::vector<std::complex<double>>& b);

[[nodiscard]] svg::Series OrderSpectrum(const std::vector<std::complex<double>>& orbit,
                                        const Orders& orders, const std::string& name,
                                        std::size_t colour);

}  // namespace levitas::signature

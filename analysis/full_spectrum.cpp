#include "analysis/full_spectrum.hpp"

#include <algorithm>

#include "numerics/fourier_transform.hpp"
#include "numerics/hann_window.hpp"

namespace levitas::analysis {

std::vector<double> FullAmplitudes(std::vector<std::complex<double>> orbit,
                                   std::size_t lines_each_side) {
  const std::size_t size = orbit.size();
  std::complex<double> mean{};
  for (const auto& value : orbit) mean += value;
  mean /= static_cast<double>(size);
  for (std::size_t n = 0; n < size; ++n) {
    orbit[n] = (orbit[n] - mean) * numerics::HannWeight(n, size);
  }
  numerics::FourierTransform(orbit);
  // The Hann window's mean is one half: a line keeps its height.
  const double scale = 2.0 / static_cast<double>(size);
  const std::size_t lines = std::min(lines_each_side, size / 2 - 1);
  std::vector<double> amplitude;
  amplitude.reserve(2 * lines + 1);
  for (std::size_t k = size - lines; k < size; ++k) amplitude.push_back(scale * std::abs(orbit[k]));
  for (std::size_t k = 0; k <= lines; ++k) amplitude.push_back(scale * std::abs(orbit[k]));
  return amplitude;
}

}  // namespace levitas::analysis

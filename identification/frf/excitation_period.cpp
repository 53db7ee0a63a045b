#include "identification/frf/excitation_period.hpp"

#include <algorithm>
#include <cmath>

namespace levitas::identification {
namespace {

constexpr double kSame = 1e-6;
constexpr std::size_t kShortest = 8;

bool Repeats(std::span<const double> signal, std::size_t period, double tolerance) {
  for (std::size_t n = period; n < signal.size(); ++n) {
    if (std::abs(signal[n] - signal[n - period]) > tolerance) return false;
  }
  return true;
}

}  // namespace

std::optional<std::size_t> RepeatsAfter(std::span<const double> signal) {
  double largest = 0.0;
  for (const double value : signal) largest = std::max(largest, std::abs(value));
  if (largest == 0.0) return std::nullopt;
  for (std::size_t period = kShortest; 2 * period <= signal.size() + 1; ++period) {
    if (Repeats(signal, period, kSame * largest)) return period;
  }
  return std::nullopt;
}

}  // namespace levitas::identification

#include "diagnosis/inference/validation_doubt.hpp"

#include <algorithm>
#include <cmath>

namespace levitas::diagnosis {
namespace {

/// What data cannot show is worth the rounding of their sums, which does not scatter.
constexpr double kRounding = 1e-3;

}  // namespace

Doubt DoubtOf(double gain, double deviation, double deviations) noexcept {
  const double least = std::max(kRounding, deviations * deviation);
  if (!std::isfinite(gain) || gain < -least) return Doubt::kValidationHarm;
  const bool shows = deviation > 4.0 * deviations;
  return gain > least || !shows ? Doubt::kNothing : Doubt::kUnconfirmed;
}

double ChanceOfGain(double gain, double deviation) noexcept {
  if (!std::isfinite(gain)) return 0.0;
  return 0.5 * std::erfc(-gain / (std::sqrt(2.0) * std::max(kRounding, deviation)));
}

double ChanceOfOpen(double fitted_nat, double gain_nat, std::size_t effects) noexcept {
  return 1.0 / (1.0 + static_cast<double>(effects) * std::exp(-(fitted_nat + gain_nat)));
}

}  // namespace levitas::diagnosis

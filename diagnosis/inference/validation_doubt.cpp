#include "diagnosis/inference/validation_doubt.hpp"

#include <algorithm>
#include <cmath>

namespace levitas::diagnosis {
namespace {

/// What data cannot show is worth the rounding of their sums, which does not scatter.
constexpr double kRounding = 1e-3;

}  // namespace

bool Confirms(double gain, double deviation, double deviations) noexcept {
  return std::isfinite(gain) && gain > std::max(kRounding, deviations * deviation);
}

Doubt DoubtOf(double gain, double deviation, double deviations) noexcept {
  if (!std::isfinite(gain) || Confirms(-gain, deviation, deviations)) return Doubt::kValidationHarm;
  const bool shows = deviation > 8.0 * deviations;
  return Confirms(gain, deviation, deviations) || !shows ? Doubt::kNothing : Doubt::kUnconfirmed;
}

double ChanceOfGain(double gain, double deviation) noexcept {
  if (!std::isfinite(gain)) return 0.0;
  return 0.5 * std::erfc(-gain / (std::sqrt(2.0) * std::max(kRounding, deviation)));
}

double ChanceOfOpen(double fitted_nat, double gain_nat, std::size_t effects) noexcept {
  return 1.0 / (1.0 + static_cast<double>(effects) * std::exp(-(fitted_nat + gain_nat)));
}

}  // namespace levitas::diagnosis

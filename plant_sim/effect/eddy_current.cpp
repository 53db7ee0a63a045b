#include "plant_sim/effect/eddy_current.hpp"

#include <cmath>
#include <numbers>

namespace levitas::effect {
namespace {

constexpr double kSlowest = 1e-4;
constexpr double kFastest = 1e2;

EddyLags Make() noexcept {
  EddyLags eddy;
  const double spacing = std::log(kFastest / kSlowest) / (kEddyLags - 1.0);
  double sum = 0.0;
  for (std::size_t k = 0; k < kEddyLags; ++k) {
    const double x = kSlowest * std::exp(spacing * static_cast<double>(k));
    eddy.rate[k] = x;
    eddy.gain[k] = spacing / std::numbers::pi * std::sqrt(x) / (1.0 + x);
    sum += eddy.gain[k];
  }
  // The integral below the slowest lag, (2/pi) atan sqrt(x), acts like that lag; what is left to
  // the static gain of 1 lies above the fastest one and is immediate.
  const double below =
      2.0 / std::numbers::pi * std::atan(std::sqrt(kSlowest * std::exp(-0.5 * spacing)));
  eddy.gain[0] += below;
  eddy.direct = 1.0 - (sum + below);
  return eddy;
}

}  // namespace

const EddyLags& Eddy() noexcept {
  static const EddyLags kEddy = Make();
  return kEddy;
}

}  // namespace levitas::effect

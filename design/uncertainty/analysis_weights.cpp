#include "design/uncertainty/analysis_weights.hpp"

#include <algorithm>
#include <cmath>

namespace levitas::uncertainty {
namespace {

/// Of any order, also beyond 1.
double Chebyshev(int order, double x) {
  return std::abs(x) <= 1.0 ? std::cos(order * std::acos(x)) : std::cosh(order * std::acosh(x));
}

}  // namespace

double DisturbanceA(const AnalysisWeights& weights, std::size_t bearing, double hz) {
  const auto& sizes = weights.disturbance_a;
  const double size = sizes.empty() ? 0.0 : sizes[std::min(bearing, sizes.size() - 1)];
  const double ripple2 = 1.0 / (std::pow(10.0, 0.1 * weights.disturbance_attenuation_db) - 1.0);
  const double t = Chebyshev(weights.disturbance_order, weights.disturbance_edge_hz / hz);
  // In the stop band |H|^2 = e^2 T^2/(1 + e^2 T^2) has zeros; the level between them is what
  // counts.
  const double square = std::abs(t) <= 1.0 ? 1.0 : t * t;
  return size * std::sqrt(ripple2 * square / (1.0 + ripple2 * square));
}

double AllowedCurrentA(const AnalysisWeights& weights, double hz) {
  return weights.control_a / std::sqrt(1.0 + std::pow(hz / weights.control_hz, 4));
}

double AllowedPositionM(const AnalysisWeights& weights, double hz) {
  const double zero_hz = weights.position_hz * weights.position_rest_m / weights.position_m;
  return weights.position_m * std::hypot(hz, zero_hz) / std::hypot(hz, weights.position_hz);
}

}  // namespace levitas::uncertainty

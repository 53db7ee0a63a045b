#include "plant_sim/gear/transmission_error.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace levitas::gear {

TransmissionError::TransmissionError(const std::vector<Harmonic>& harmonics) {
  int highest = 0;
  for (const Harmonic& h : harmonics) highest = std::max(highest, std::abs(h.order));
  pairs_.resize(static_cast<std::size_t>(highest));
  Set(harmonics);
}

void TransmissionError::Set(const std::vector<Harmonic>& harmonics) noexcept {
  mean_ = {};
  std::fill(pairs_.begin(), pairs_.end(), Pair{});
  for (const Harmonic& h : harmonics) {
    if (static_cast<std::size_t>(std::abs(h.order)) > pairs_.size()) continue;
    const Vector part{h.amplitude_m * std::cos(h.phase_rad), h.amplitude_m * std::sin(h.phase_rad)};
    if (h.order == 0) {
      mean_ = mean_ + part;
      continue;
    }
    Pair& pair = pairs_[static_cast<std::size_t>(std::abs(h.order)) - 1];
    Vector& side = h.order > 0 ? pair.forward : pair.backward;
    side = side + part;
  }
}

Prescribed TransmissionError::At(const Vector& mesh, double mesh_rad_per_s) const noexcept {
  Prescribed sum{mean_, {}};
  Vector power{1.0, 0.0};
  double rate = 0.0;
  for (const Pair& pair : pairs_) {
    power = Turned(power, mesh);
    rate += mesh_rad_per_s;
    const Vector forward = Turned(pair.forward, power);
    const Vector backward = Turned(pair.backward, {power.x, -power.y});
    sum.displacement_m = sum.displacement_m + forward + backward;
    // d/dt: forward times +j i w_e, backward times -j i w_e.
    const Vector difference = forward - backward;
    sum.rate_m_per_s = sum.rate_m_per_s + Vector{-rate * difference.y, rate * difference.x};
  }
  return sum;
}

}  // namespace levitas::gear

#include "controller/synchronous/orbit_slip.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace levitas::synchronous {

void OrbitSlip::Reset() noexcept {
  DropTurn();
  reference_ = {};
  any_turn_ = false;
}

void OrbitSlip::DropTurn() noexcept {
  sum_ = {};
  turned_ = samples_ = 0.0;
}

OrbitTurn OrbitSlip::Add(const AxisArray& position_m, const UnitPhasor& phasor, double step_turns,
                         double reference_share) noexcept {
  for (std::size_t b = 0; b < bearings_; ++b) {
    const double x_m = position_m[2 * b];
    const double y_m = position_m[2 * b + 1];
    sum_[b].real += x_m * phasor.cosine + y_m * phasor.sine;
    sum_[b].imaginary += y_m * phasor.cosine - x_m * phasor.sine;
  }
  samples_ += 1.0;
  turned_ += std::abs(step_turns);
  if (!(turned_ >= 1.0)) return {};
  const OrbitTurn turn = EndTurn(reference_share);
  turned_ -= std::floor(turned_);
  sum_ = {};
  samples_ = 0.0;
  return turn;
}

OrbitTurn OrbitSlip::EndTurn(double reference_share) noexcept {
  OrbitTurn turn{.ended = true};
  for (const Complex& sum : sum_) {
    if (!std::isfinite(sum.real) || !std::isfinite(sum.imaginary)) return turn;
  }
  Complex ahead;
  for (std::size_t b = 0; b < bearings_; ++b) {
    Complex& reference = reference_[b];
    const Complex orbit{sum_[b].real / samples_, sum_[b].imaginary / samples_};
    turn.forward_m = std::max(
        turn.forward_m, std::sqrt(orbit.real * orbit.real + orbit.imaginary * orbit.imaginary));
    ahead.real += orbit.real * reference.real + orbit.imaginary * reference.imaginary;
    ahead.imaginary += orbit.imaginary * reference.real - orbit.real * reference.imaginary;
    const double share = any_turn_ ? reference_share : 1.0;
    reference.real += share * (orbit.real - reference.real);
    reference.imaginary += share * (orbit.imaginary - reference.imaginary);
  }
  const double size = std::sqrt(ahead.real * ahead.real + ahead.imaginary * ahead.imaginary);
  if (any_turn_ && size > 0.0) {
    constexpr double kQuarter = 0.25;
    turn.ahead_turns = ahead.real > 0.0 ? ahead.imaginary / size / (2.0 * std::numbers::pi)
                                        : std::copysign(kQuarter, ahead.imaginary);
  }
  any_turn_ = true;
  return turn;
}

}  // namespace levitas::synchronous

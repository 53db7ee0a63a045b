#include "controller/synchronous/generalised_notch.hpp"

#include <algorithm>
#include <cmath>

namespace levitas::synchronous {
namespace {

// Of a fixed width, so that the inner loops are a few vector instructions.
template <std::size_t kWidth>
void AdaptWidth(const InverseLanes& inverse, const UnitPhasor& phasor, double rate,
                const AxisArray& error, NotchState& state) noexcept {
  std::array<double, kWidth> real{};
  std::array<double, kWidth> imaginary{};
  for (std::size_t from = 0; from < kWidth; ++from) {
    const double e = error[from];
    const double* __restrict re = inverse.real[from].data();
    const double* __restrict im = inverse.imaginary[from].data();
    for (std::size_t to = 0; to < kWidth; ++to) {
      real[to] += re[to] * e;
      imaginary[to] += im[to] * e;
    }
  }
  const double cosine = rate * phasor.cosine;
  const double sine = rate * phasor.sine;
  for (std::size_t i = 0; i < kWidth; ++i) {
    state.real[i] += real[i] * cosine + imaginary[i] * sine;
    state.imaginary[i] += imaginary[i] * cosine - real[i] * sine;
  }
}

}  // namespace

void Adapt(const InverseLanes& inverse, const UnitPhasor& phasor, double rate, std::size_t axes,
           const AxisArray& error, NotchState& state) noexcept {
  if (axes <= 4) {
    AdaptWidth<4>(inverse, phasor, rate, error, state);
  } else {
    AdaptWidth<kMaxAxes>(inverse, phasor, rate, error, state);
  }
}

double LargestAmplitude(const NotchState& state) noexcept {
  static_assert((kMaxAxes & (kMaxAxes - 1)) == 0, "it is halved");
  AxisArray largest{};
  for (std::size_t i = 0; i < kMaxAxes; ++i) {
    largest[i] = state.real[i] * state.real[i] + state.imaginary[i] * state.imaginary[i];
  }
  AxisArray sum = largest;
  // In pairs: one after the other each comparison would wait for the one before.
  for (std::size_t half = kMaxAxes / 2; half > 0; half /= 2) {
    for (std::size_t i = 0; i < half; ++i) {
      largest[i] = std::max(largest[i], largest[i + half]);
      sum[i] += sum[i + half];
    }
  }
  // A comparison loses what is no number; the sum does not.
  return std::isfinite(sum[0]) ? std::sqrt(largest[0]) : sum[0];
}

}  // namespace levitas::synchronous

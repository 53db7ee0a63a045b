#pragma once
// One generalised notch: the synchronous part of a signal, adapted in the frame that turns.
//
// Equation   p = e^{j n theta},  out_i = g Re(c_i p),  c <- c + (2 T_s/tau) (T e) conj(p)
//            (docs/derivations.md eq. (N1)-(N4)). At constant speed it is a linear filter of two
//            states per axis with its poles at n times the speed. Where T is the inverse of what
//            `e` answers to `out` with, c goes to its end as exp(-t/tau).
// Stability  for a slow notch (1/tau small against the loop's own decay): the eigenvalues of T S
//            lie in the right half plane, S the answer at that frequency. Who makes T proves it;
//            nothing here can know.
// Gain       g fades out what a block gave when it ends; the amplitudes stay until then.
// Units      of the signals: e [m]; c [m] or [A], T [1] or [A/m].
// Thread     loop thread only; no allocation, nothing thrown.
// Not done   no limit of c, no judgement of the angle: synchronous_control.hpp.

#include "common/axes.hpp"
#include "common/unit_phasor.hpp"
#include "controller/synchronous/inverse_ladder.hpp"

namespace levitas::synchronous {

struct NotchState {
  AxisArray real{};
  AxisArray imaginary{};
};

/// Adds `scale` Re(c p) to `signal`.
inline void AddTurning(const AxisArray& real, const AxisArray& imaginary, const UnitPhasor& phasor,
                       double scale, AxisArray& signal) noexcept {
  const double cosine = scale * phasor.cosine;
  const double sine = scale * phasor.sine;
  for (std::size_t i = 0; i < kMaxAxes; ++i) {
    signal[i] += real[i] * cosine - imaginary[i] * sine;
  }
}

/// One period; `rate` = 2 T_s/tau. Axes from `axes` on stay untouched.
void Adapt(const InverseLanes& inverse, const UnitPhasor& phasor, double rate, std::size_t axes,
           const AxisArray& error, NotchState& state) noexcept;

/// Largest amplitude of an axis.
[[nodiscard]] double LargestAmplitude(const NotchState& state) noexcept;

}  // namespace levitas::synchronous

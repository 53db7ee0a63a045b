#pragma once
// Hysteresis of the iron as a rate-independent operator on the control current.
//
// Equation   effective = ic - w z,  dz = (u/2)^n |d ic|/w sign(d ic),  u = 1 - z sign(d ic)
//            in 0 .. 2; n = 0 is the play operator of half width w, n = 1 the exponential approach.
//            Closed form along a monotone piece of current, so the result depends on the turning
//            points alone and not on the steps in between.
// Source     Dahl (1968), TOR-158, for the family; Coleman & Hodgdon (1986), Int. J. Eng. Sci.
//            24(6) 897, for iron; Krasnosel'skii & Pokrovskii (1989) for play.
// State      z in -1 .. 1 per axis; 0 = demagnetised.
// Thread     any; pure. Not done: minor loops of the congruency that Preisach's model has.

#include <algorithm>
#include <cmath>

namespace levitas::effect {

/// z after the control current has moved from `before_a` to `after_a`. `width_a` > 0, `shape` 0..2.
[[nodiscard]] inline double HysteresisStep(double width_a, double shape, double z, double before_a,
                                           double after_a) noexcept {
  const double moved_a = after_a - before_a;
  if (moved_a == 0.0) return z;
  const double sign = moved_a > 0.0 ? 1.0 : -1.0;
  const double u = std::clamp(1.0 - sign * z, 0.0, 2.0);
  // In v = u/2: dv/ds = -v^n with s = |d ic|/(2 w).
  const double v = 0.5 * u;
  const double s = 0.5 * std::abs(moved_a) / width_a;
  double after = 0.0;
  if (std::abs(shape - 1.0) < 1e-6) {
    after = v * std::exp(-s);
  } else if (shape == 0.0) {
    after = std::max(0.0, v - s);
  } else if (v > 0.0) {
    const double power = 1.0 - shape;
    const double base = std::pow(v, power) - power * s;
    after = base > 0.0 ? std::pow(base, 1.0 / power) : 0.0;
  }
  return sign * (1.0 - 2.0 * after);
}

}  // namespace levitas::effect

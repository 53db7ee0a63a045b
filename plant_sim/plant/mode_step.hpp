#pragma once
// Exact step of one modal oscillator x'' + 2 z w x' + w^2 x = n over a time h.
//
// Equation   x(h) = xx x + xv v + x0 n0 + x1 (n1 - n0), the same for v, exact when n runs linearly
//            from n0 to n1. docs/derivations.md (29)-(33). Holds for w = 0 and 0 <= z < 1.
// Thread     any; pure.

namespace levitas::plant {

struct ModeStep {
  double xx{}, xv{}, vx{}, vv{};  ///< free motion
  double x0{}, v0{};              ///< response to a constant unit acceleration
  double x1{}, v1{};              ///< response to one that grows from 0 to 1 over the step
};

[[nodiscard]] ModeStep MakeModeStep(double frequency_rad_per_s, double damping_ratio,
                                    double duration_s);

}  // namespace levitas::plant

#pragma once
// One-step predictions of the ball's position, driven by the coil currents.
//
// Equation   m (1 + mass) (x'' + g) = F_up - F_down + load - c x' - k x - friction tanh(x'/v)
//              F_up = f0 (1 + f) s(i)^2 i^n e^(-z0/d) e^(x (1 + stiffness)/d),
//              v = 2 mm/s, s(i) = i/sqrt(1 + knee i^2), late by the force's lag (first order)
//            reading = (1 + g) x + offset + a2 x^2 + a3 x^3, late by the sensor's lag
// Observer   position and velocity corrected at every sample by fixed gains (both poles at
//            kObserverRadPerS), whatever the parameters, since the ball is unstable alone: what
//            remains is a smooth function of them.
// Currents   as measured, the probe's own errors undone; without probes those of coil_run.hpp.
// Step       midpoint rule over a period: 4 % of the fastest time constant, an error of 1e-5.
// Thread     any; pure.

#include "diagnosis/levitator/coil_run.hpp"

namespace levitas::levitator {

inline constexpr double kObserverRadPerS = 60.0;

/// Measured minus predicted, row by row [m]; zero where there is no prediction.
[[nodiscard]] std::vector<double> Innovations(const NominalRig& rig, const Series& series,
                                              const Theta& theta, std::size_t record,
                                              const CoilRun& modelled);

}  // namespace levitas::levitator

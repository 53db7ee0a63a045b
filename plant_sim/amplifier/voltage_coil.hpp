#pragma once
// A coil on a voltage: no current loop, the current follows by the coil's own inductance.
//
// Equation   i' = (steady u + offset - i)/tau + emf i gap'/d,   tau = tau0 e^(-gap/d),
//            u the current that the commanded voltage would drive at last. The first term is the
//            law that INTECO gives for its levitator MLS2EM; the second, from d(L i)/dt with the
//            same L(gap), is what the rotor induces by moving, which that law leaves out (emf = 0).
// Step       closed form for a command that is constant and a gap taken at the middle of the step.
// Sign       a coil on a one-way bridge: the current never falls below zero.
// Thread     any; pure. Not done: resistance that changes with temperature.

#include <algorithm>
#include <cmath>

namespace levitas::amplifier {

struct VoltageCoil {
  double steady{1.0};
  double offset_a{};
  double time_constant_s{};  ///< tau0; 0 = the coil is on a current loop instead
  double decay_m{};
  double motion_emf{};
};

[[nodiscard]] inline double TimeConstant(const VoltageCoil& coil, double gap_m) noexcept {
  return coil.time_constant_s * std::exp(-gap_m / coil.decay_m);
}

/// The current after `duration_s`. `gap_m` and its rate are those in the middle of the step; a coil
/// that is switched off has no offset either.
[[nodiscard]] inline double Follow(const VoltageCoil& coil, double now_a, double command_a,
                                   bool enabled, double gap_m, double gap_rate_m_per_s,
                                   double duration_s) noexcept {
  const double decay_1_per_s = 1.0 / TimeConstant(coil, gap_m);
  const double rate_1_per_s = decay_1_per_s - coil.motion_emf * gap_rate_m_per_s / coil.decay_m;
  const double drive_a_per_s =
      enabled ? (coil.steady * command_a + coil.offset_a) * decay_1_per_s : 0.0;
  const double turns = rate_1_per_s * duration_s;
  const double weight_s = std::abs(turns) < 1e-12 ? duration_s : -std::expm1(-turns) / rate_1_per_s;
  return std::max(0.0, now_a * std::exp(-turns) + drive_a_per_s * weight_s);
}

}  // namespace levitas::amplifier

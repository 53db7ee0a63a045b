#pragma once
// A coil on a voltage: no current loop, the current follows by the coil's own inductance.
//
// Equation   i' = (steady u(c) + offset - r i)/tau + emf i gap'/d
//              tau = tau0 e^(-gap/d)/(1 + s i^2)             inductance, less as the iron fills
//              u = v + q v (1 - c/full),  v = max(0, c - b)  dead band b, curvature q of the drive
//            c the current that the commanded voltage would drive at last in a coil without either,
//            r its resistance over the nominal one (it warms). The first term, with u = c, r = 1
//            and s = 0, is the law that INTECO gives for its levitator MLS2EM; the last, from
//            d(L i)/dt with the same L(gap), is what the rotor induces by moving, which that law
//            leaves out (emf = 0).
// Source     iron: Fitzgerald, Kingsley & Umans 2003, Electric Machinery, ch. 1, to second order.
// Step       closed form for a command that is constant, a gap taken at the middle of the step and
//            iron as the current at its start fills it: exact without iron and motion.
// Sign       a coil on a one-way bridge: the current never falls below zero.
// Thread     any; pure.

#include <algorithm>
#include <cmath>

namespace levitas::amplifier {

struct VoltageCoil {
  double steady{1.0};
  double offset_a{};
  double time_constant_s{};  ///< tau0; 0 = the coil is on a current loop instead
  double decay_m{};
  double motion_emf{};
  double dead_band_a{};    ///< b
  double curvature{};      ///< q
  double full_a{1.0};      ///< what full duty asks for
  double iron_1_per_a2{};  ///< s
};

[[nodiscard]] inline double TimeConstant(const VoltageCoil& coil, double gap_m) noexcept {
  return coil.time_constant_s * std::exp(-gap_m / coil.decay_m);
}

/// What the bridge makes of what is asked for: u(c).
[[nodiscard]] inline double Driven(const VoltageCoil& coil, double command_a) noexcept {
  if (coil.dead_band_a == 0.0 && coil.curvature == 0.0) return command_a;
  const double beyond_a = std::max(0.0, command_a - coil.dead_band_a);
  return beyond_a + coil.curvature * beyond_a * (1.0 - command_a / coil.full_a);
}

/// du/dc.
[[nodiscard]] inline double DrivenSlope(const VoltageCoil& coil, double command_a) noexcept {
  if (coil.dead_band_a == 0.0 && coil.curvature == 0.0) return 1.0;
  const double beyond_a = command_a - coil.dead_band_a;
  if (beyond_a <= 0.0) return 0.0;
  return 1.0 + coil.curvature * (1.0 - (command_a + beyond_a) / coil.full_a);
}

/// The current after `duration_s`. `gap_m` and its rate are those in the middle of the step; a coil
/// that is switched off has no offset either. `resistance` is over the nominal one.
[[nodiscard]] inline double Follow(const VoltageCoil& coil, double now_a, double command_a,
                                   bool enabled, double gap_m, double gap_rate_m_per_s,
                                   double duration_s, double resistance = 1.0) noexcept {
  const double iron = 1.0 + coil.iron_1_per_a2 * now_a * now_a;
  const double decay_1_per_s = 1.0 / TimeConstant(coil, gap_m) * iron;
  const double rate_1_per_s =
      resistance * decay_1_per_s - coil.motion_emf * gap_rate_m_per_s / coil.decay_m;
  const double drive_a_per_s =
      enabled ? (coil.steady * Driven(coil, command_a) + coil.offset_a) * decay_1_per_s : 0.0;
  const double turns = rate_1_per_s * duration_s;
  const double weight_s = std::abs(turns) < 1e-12 ? duration_s : -std::expm1(-turns) / rate_1_per_s;
  return std::max(0.0, now_a * std::exp(-turns) + drive_a_per_s * weight_s);
}

/// Resistance over the nominal one of a coil that warms at a constant rate. It never vanishes.
[[nodiscard]] inline double Warmed(double warming_1_per_s, double time_s) noexcept {
  constexpr double kLeast = 0.05;
  return std::max(kLeast, 1.0 + warming_1_per_s * time_s);
}

}  // namespace levitas::amplifier

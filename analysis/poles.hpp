#pragma once
// Closed-loop poles of the sampled loop, delay included.
//
// Equation   eigenvalues z of the loop closed over plant and discrete law; s = ln(z)/T.
// Frequency  Im(s)/2 pi, signed by the whirl direction of the rotor in that mode: forward (x to y,
//            the sense of rotation) positive. x + j y of the mode e^{jwt} v is
//            (v_x + j v_y) e^{jwt}/2 + conj(v_x - j v_y) e^{-jwt}/2: forward when the first
//            dominates. Where both planes have the same pole (an isotropic rotor at rest) the sign
//            is a convention and one of the two is listed each way.
// Counting   one entry per conjugate pair; a real pole that both planes share is listed once, so
//            an isotropic rig lists the poles of its complex model.
// Damping    -Re(s)/|s|.
// Thread     any.

#include <complex>
#include <string>
#include <vector>

#include "controller/law/law_config.hpp"
#include "plant_sim/plant/operating_point.hpp"
#include "plant_sim/plant/plant_config.hpp"

namespace levitas::analysis {

struct SampledLoop;

struct Pole {
  std::complex<double> z;            ///< [1] conjugate with positive imaginary part
  std::complex<double> s_rad_per_s;  ///< ln(z)/T
  double frequency_hz{};             ///< signed: forward positive, backward negative
  double damping_ratio{};
  double forward_share{};  ///< [1] 1 forward whirl, 0 backward, 0.5 motion in one plane
};

struct LoopPoles {
  double speed_rad_per_s{};
  bool stable{};                ///< every |z| < 1, and the static load is carried
  plant::OperatingPoint point;  ///< about which the loop is linear
  double largest_pole_modulus{};
  std::vector<Pole> poles;       ///< ascending |frequency|; poles at z = 0 are left out
  std::size_t deadbeat_poles{};  ///< eigenvalues at z = 0 (pure delay)
};

/// On or outside the unit circle: its motion does not decay.
[[nodiscard]] bool Grows(const Pole& pole);

/// Of a loop that is not stable: "a pole at 90.1 Hz grows e-fold every 12 ms", or that the magnets
/// cannot carry the static load.
[[nodiscard]] std::string WhyUnstable(const LoopPoles& loop);

/// The same poles, worst first: those that grow, fastest first, then by rising damping ratio.
[[nodiscard]] std::vector<Pole> WorstFirst(std::vector<Pole> poles);

[[nodiscard]] LoopPoles PolesOf(const SampledLoop& loop, double speed_rad_per_s);

/// Throws BadInput when the law's axes do not fit the plant's.
[[nodiscard]] LoopPoles ClosedLoopPoles(const plant::PlantConfig& plant, const law::LawConfig& law,
                                        double speed_rad_per_s);

}  // namespace levitas::analysis

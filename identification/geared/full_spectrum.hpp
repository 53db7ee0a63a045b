#pragma once
// Parameters of a geared rotor with magnetic bearings from the lines of its full spectrum.
//
// Model     4 DOF, complex r = x + jy per shaft, mesh k_m, c_m, run-out eps, and the
//           transmission error's harmonics e_i:
//             Zp Rp + (k_m + jW c_m) D = m_p eps_p w_p^2 [1x of the pinion] + ks_p Rp - ki_p Ip
//             Zg Rg - (k_m + jW c_m) D = m_g eps_g w_g^2 [1x of the gear]   + ks_g Rg - ki_g Ig
//           Z = k + jW c - m W^2 known; D = Rp - Rg (+ eps_p, - eps_g, - e_i on their lines).
// Method    linear least squares, twice. The sum of both equations has no mesh in it: ks, ki, eps
//           of both shafts. Then the mesh force is known on every line: k_m and c_m from the lines
//           of rotation, every e_i from its own lines, all speeds stacked.
// Lines     pinion_1x at +w_p, gear_1x at -w_g, mesh_+1, mesh_-1 ... at i z_p w_p (negative:
//           backward), mean at 0.
// Errors    standard deviations from the residual of each step (noise alike on all lines);
//           condition number of the first step's design with columns of unit length.
// Units     SI, complex amplitudes. Thread any.
// Failure   BadInput: fewer than two speeds, lines missing, or a design of too small rank.

#include <Eigen/Core>
#include <complex>
#include <string>
#include <vector>

namespace levitas::identification {

struct GearedLine {
  enum class Kind { kPinion, kGear, kTransmissionError };
  Kind kind{};
  int harmonic{};                ///< with kTransmissionError
  double speed_rad_per_s{};      ///< of the pinion
  double frequency_rad_per_s{};  ///< signed: forward positive
  std::complex<double> pinion_m, gear_m;
  std::complex<double> pinion_a, gear_a;
};

struct ShaftKnown {
  double mass_kg{}, damping_n_s_per_m{}, stiffness_n_per_m{};
};

struct ShaftFound {
  double ks_n_per_m{}, ks_sigma{};
  double ki_n_per_a{}, ki_sigma{};
  std::complex<double> run_out_m;
  double run_out_sigma{};
};

struct TransmissionError {
  int harmonic{};
  std::complex<double> amplitude_m;
  double sigma{};
};

struct GearedParameters {
  ShaftFound pinion, gear;
  double mesh_stiffness_n_per_m{}, mesh_stiffness_sigma{};
  double mesh_damping_n_s_per_m{}, mesh_damping_sigma{};
  std::vector<TransmissionError> error;  ///< ascending harmonic
  double condition{};
};

[[nodiscard]] GearedParameters IdentifyGeared(const std::vector<GearedLine>& lines,
                                              const ShaftKnown& pinion, const ShaftKnown& gear);

/// Reads the lines: columns pinion_speed_hz, line (named as above),
/// frequency_hz, then real and imaginary parts of both positions and both currents.
[[nodiscard]] std::vector<GearedLine> ReadGearedLines(const std::string& path);

}  // namespace levitas::identification

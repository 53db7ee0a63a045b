#pragma once
// Parameters of a geared rotor with magnetic bearings from the lines of its full spectrum.
//
// Model     complex r = x + jy per shaft, W a line's signed frequency, mesh k_m, c_m, run-out eps,
//           transmission error e_i; f the force between the teeth:
//             Zp Rp + f = m_p eps_p w_p^2 [1x of the pinion] + ks_p Rp - ki_p Ip
//             Zg Rg - f = m_g eps_g w_g^2 [1x of the gear]   + ks_g Rg - ki_g Ig
//             f = (k_m + jW c_m) D,  D = Rp - Rg (+ eps_p, - eps_g, - e_i on their lines) + n w
// Sign      a positive I pushes against r, as in the source and in the files of `--lines`; records
//           have the other sign, which LinesOfRecord turns (record_lines.hpp).
// Z         4 DOF: k + jW c - m W^2. 8 DOF: the tilts leave it by dynamic reduction, exact on every
//           line: - k_la^2/(k_aa - I_d W^2 + I_p w W). 12 DOF: w, the rotation of both wheels times
//           their base radii, is real; its half spectrum follows from that of the mesh force along
//           the line of action n through the known torsion: w = -G (f n* + (f(-W))* n)/2.
// Method    linear least squares, twice; then, where lines have a noise or known numbers a doubt,
//           all of it together from there (joint_fit.hpp). The sum of both equations has no mesh in
//           it: ks, ki, eps of both shafts. Then the mesh force is known on every line: k_m and c_m
//           from the lines of rotation, every e_i from its own lines, all speeds stacked. Lines
//           with standard deviations are weighted by what their noise does to the equation.
// Known     masses, dampings and stiffnesses; with `uncertainty`, their relative standard
//           deviation, a correction of each is fitted too, held to 0 by that. Where the law's
//           current is alike on all lines, ks, ki and the shaft's stiffness show as one sum; then
//           ks/ki = i0/s0 of the magnet, known as well as the rest, tells them apart.
// Lines     pinion_1x at +w_p, gear_1x at -w_g, mesh_+1, mesh_-1 ... at i z_p w_p (negative:
//           backward), mean at 0; with torsion also pinion_-1x and gear_+1x, which carry no
//           run-out. With torsion the mean error along n is not told apart from the wheels'
//           rotation.
// Planes    R is at the gear. Where a shaft's probe, magnet and gear stand at planes of their own,
//           its elastic model says what one plane of probes tells of the gear (elastic_shaft.hpp);
//           lines on which the probe stands near a node are left out (probe_planes.hpp).
// Errors    standard deviations of the joint fit, else from the residual of each step; condition
//           number of the first step's design with columns of unit length.
// Units     SI, complex amplitudes. Thread any.
// Failure   BadInput: fewer than two speeds, lines missing, a design of too small rank, a negative
//           ki, forces on the shafts that the model leaves unexplained, or a probe at a node.

#include <Eigen/Core>
#include <complex>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace levitas::identification {

struct GearedLine {
  enum class Kind { kPinion, kGear, kTransmissionError, kMirror };
  Kind kind{};
  int harmonic{};                ///< with kTransmissionError
  double speed_rad_per_s{};      ///< of the pinion
  double frequency_rad_per_s{};  ///< signed: forward positive
  std::complex<double> pinion_m, gear_m;
  std::complex<double> pinion_a, gear_a;
  double sigma_m{}, sigma_a{};  ///< of each amplitude; 0: unknown, all lines count alike
};

struct ElasticShaft;

struct ShaftKnown {
  double mass_kg{}, damping_n_s_per_m{}, stiffness_n_per_m{};
  double coupling_n{}, tilt_stiffness_n_m{};  ///< k_la, k_aa; both 0: no tilt
  double diametral_kg_m2{}, polar_kg_m2{};
  double ratio{1.0};                  ///< of its speed to the pinion's
  double ki_n_per_a{}, ks_n_per_m{};  ///< of the magnet's drawing: only ks/ki = i0/s0 is used
  /// A shaft with planes of their own. Then the mass is the one that the run-out moves, the
  /// stiffness the static one at the magnet, and the ratios are those to the elastic model.
  std::shared_ptr<const ElasticShaft> elastic{};
  double mass_ratio{1.0}, damping_ratio{1.0}, stiffness_ratio{1.0}, gyroscopic_ratio{1.0};
};

/// Torsional modes as seen by the mesh.
struct TorsionKnown {
  std::complex<double> normal;  ///< n
  Eigen::VectorXd frequency_rad_per_s, damping_ratio;
  Eigen::VectorXd twist_m;          ///< base radius times rotation, both wheels
  Eigen::MatrixXd damping_1_per_s;  ///< of drives and brakes, modal
};

struct GearedKnown {
  ShaftKnown pinion, gear;
  std::optional<TorsionKnown> torsion;
  double uncertainty{};  ///< relative, of mass, damping and stiffness of the shafts, and torsion
};

/// How well the probes of an elastic shaft see its gear (probe_planes.hpp).
struct ProbePlane {
  double probe_z_m{}, gear_z_m{};
  double amplification{};         ///< gear per probe, largest of the lines that were used
  double median_amplification{};  ///< of those lines
  double at_rad_per_s{};          ///< line with the largest
  std::size_t left_out{};         ///< lines on which the probe stands near a node
};

struct ShaftFound {
  double ks_n_per_m{}, ks_sigma{};
  double ki_n_per_a{}, ki_sigma{};
  std::complex<double> run_out_m;
  double run_out_sigma{};
  std::optional<ProbePlane> plane{};  ///< of an elastic shaft
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
  GearedKnown corrected;  ///< what was known, as the lines correct it; equal without `uncertainty`
  bool mean_along_line_unknown{};  ///< the mean error is its part across the line of action
};

[[nodiscard]] GearedParameters IdentifyGeared(const std::vector<GearedLine>& lines,
                                              const GearedKnown& known);

/// Reads the lines: columns pinion_speed_hz, line (named as above),
/// frequency_hz, then real and imaginary parts of both positions and both currents.
[[nodiscard]] std::vector<GearedLine> ReadGearedLines(const std::string& path);

}  // namespace levitas::identification

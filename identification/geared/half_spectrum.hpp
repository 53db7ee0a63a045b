#pragma once
// Half spectrum of the measured torsion of a geared rig, beside that of the identified model.
//
// Why half  torque and twist are real: their line at -W is the conjugate of that at W, so that only
//           W >= 0 says something. An amplitude A stands for Re(A exp(jWt)).
// Lines     of the pinion's rotation, of the gear's, and the harmonics of the mesh, per steady
//           stretch (steady_stretches.hpp), by least squares with the rotor's angle; the standard
//           deviation from what remains.
// Model     what the shafts of the identified model need gives the mesh force f
//           (geared_forces.hpp); along the line of action it turns the wheels, and a coupling c
//           carries
//             M_c(W) = -2 k_c s_c' D^-1 t (n* f(W) + n f(-W)*)/2,
//           D the torsional modes' dynamics, t the twist of the mesh, s_c that of the coupling, per
//           mode. Nothing of it is fitted to the torque.
// Stiffness k_c of the gauge's spring from both of its readings, by total least squares over lines
//           that stand out of the noise: M = k theta.
// Units     SI, complex peak amplitudes. Thread any.
// Failure   BadInput when the record holds no torsion of a stretch, when its gauges are on a
//           coupling that the rig does not have, and when the rig began anew within it.

#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "configuration/rig_file.hpp"
#include "identification/geared/full_spectrum.hpp"
#include "session/exchange/recording.hpp"
#include "session/log/torsion_recording.hpp"

namespace levitas::identification {

struct TorsionLine {
  std::size_t coupling{};  ///< index into HalfSpectrum::couplings
  std::string name;        ///< "pinion_1x", "gear_1x", "mesh_1" ...
  double speed_rad_per_s{};
  double frequency_rad_per_s{};
  std::complex<double> torque_n_m, twist_rad;
  double torque_sigma_n_m{}, twist_sigma_rad{};   ///< of the real and of the imaginary part
  std::optional<std::complex<double>> model_n_m;  ///< none where probes do not see the line
};

struct CouplingFound {
  std::string name;
  double known_n_m_per_rad{};  ///< of the rig file
  double stiffness_n_m_per_rad{}, stiffness_sigma{};
  std::size_t lines_used{};  ///< 0: no line stands out, nothing is found
  /// [1] share of the measured lines' power, less that of their noise, that the model leaves; none
  /// where probes see no line of it.
  std::optional<double> unexplained_share;
};

struct HalfSpectrum {
  std::vector<CouplingFound> couplings;
  std::vector<TorsionLine> lines;
};

/// `lines` and `found` of the same record.
[[nodiscard]] HalfSpectrum HalfSpectrumOf(const session::Recording& record,
                                          const session::TorsionRecording& torsion,
                                          const configuration::RigFile& rig,
                                          const std::vector<GearedLine>& lines,
                                          const GearedParameters& found, int harmonics = 5);

}  // namespace levitas::identification

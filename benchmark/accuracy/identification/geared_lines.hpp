#pragma once
// Steady lines of a linear geared rotor with ideal PD control, without noise.
//
// Model     harmonic balance in real coordinates x, y of both discs, their tilts and four torsional
//           inertias, written out as matrices: nothing of it is shared with the identification.
// Lines     0, +w_p, -w_g, +-i z_p w_p to the fifth; with torsion also their mirrors.
// Units     SI. Thread any, pure.

#include <complex>
#include <cstdint>
#include <vector>

#include "configuration/rig_file.hpp"
#include "identification/geared/full_spectrum.hpp"
#include "plant_sim/gear/gear_config.hpp"

namespace levitas::accuracy {

struct GearedPlan {
  std::vector<double> speeds_hz{15.0, 18.0, 21.0, 24.0, 27.0, 29.0};  ///< of the pinion
  double kp_a_per_m{2.4e4}, kd_a_s_per_m{20.0};
  double noise{};        ///< share of the rms, per sample
  double model_error{};  ///< relative
  double seconds{20.0};  ///< of each speed, at the rig's sampling
  std::uint64_t seed{1};
};

/// A current that the law did not ask for, on one line.
struct AddedCurrent {
  double frequency_rad_per_s{};  ///< signed, of a line
  std::size_t shaft{};           ///< 0 pinion, 1 gear
  std::complex<double> current_a;
};

[[nodiscard]] std::vector<identification::GearedLine> LinesAt(
    const configuration::RigFile& rig, const GearedPlan& plan, double speed_rad_per_s,
    const std::vector<AddedCurrent>& added = {});

[[nodiscard]] double KsOf(const plant::BearingConfig& bearing);
[[nodiscard]] double KiOf(const plant::BearingConfig& bearing);
[[nodiscard]] std::complex<double> ErrorOf(const gear::GearPair& pair, int order);
[[nodiscard]] std::complex<double> RunOut(const gear::Wheel& wheel);

}  // namespace levitas::accuracy

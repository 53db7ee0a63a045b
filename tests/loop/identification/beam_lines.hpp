#pragma once
// Steady lines of two geared beams with ideal PD control, whose gear, magnet and probe stand at
// planes of their own, without noise.
//
// Model     harmonic balance in x and y of all nodes of both finite-element models, deflections and
//           slopes, supports, magnets and teeth as matrices: no modes, no complex coordinate, no
//           elimination, which are what the identification is made of.
// Lines     0, +w_p, -w_g, +-i z_p w_p to the fifth.
// Units     SI. Thread any, pure.

#include <vector>

#include "configuration/rig_file.hpp"
#include "identification/geared/full_spectrum.hpp"

namespace levitas::test {

/// Places along both shafts of 0.5 m.
struct Planes {
  double gear_z_m{0.2}, magnet_z_m{0.28}, probe_z_m{0.26};
};

/// Two steel shafts of 0.5 m on springs and dampers at their ends, discs of 2 and 3.5 kg at the
/// gears; the gear pair, the magnets and all else of geared_rotor_4dof.
[[nodiscard]] configuration::RigFile BeamRig(const Planes& pinion, const Planes& gear);

/// At every pinion speed [Hz], with 6e3 A/m and 5 A s/m.
[[nodiscard]] std::vector<identification::GearedLine> BeamLines(
    const configuration::RigFile& rig, const std::vector<double>& speeds_hz);

}  // namespace levitas::test

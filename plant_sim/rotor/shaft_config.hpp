#pragma once
// Description of the shafts of a geared rig. A rig has one free rotor (rotor_config.hpp) or several
// shafts that stand on supports of their own and are coupled by gears.
//
// Lumped     one rigid disc on a massless elastic shaft: deflection r, and tilt psi if `tilts`:
//              m r'' + c r' + kll r + kla psi = f,   Id psi'' - j Ip W psi' + kla r + kaa psi = 0
// Beam       finite elements, free; its supports are springs and dampers at planes.
// Torsion    rotation of inertias about the shaft axis, relative to the prescribed rotation.
// Units      SI. z along the shaft from its own drive end.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "plant_sim/rotor/rotor_config.hpp"

namespace levitas::rotor {

struct LumpedShaft {
  double z_m{};  ///< place of the disc: the only plane there is
  double mass_kg{};
  double damping_n_s_per_m{};  ///< of the deflection, to ground
  double kll_n_per_m{};
  bool tilts{};
  double kla_n{};
  double kaa_n_m{};
  double diametral_inertia_kg_m2{};
  double polar_inertia_kg_m2{};
};

/// Spring and damper from a plane of the shaft to ground.
struct Support {
  double z_m{};
  double stiffness_x_n_per_m{};
  double stiffness_y_n_per_m{};
  double damping_x_n_s_per_m{};
  double damping_y_n_s_per_m{};
};

struct TorsionInertia {
  std::string name;
  double inertia_kg_m2{};
  double stiffness_n_m_per_rad{};         ///< of the shaft to the next inertia; unused by the last
  double ground_stiffness_n_m_per_rad{};  ///< of a drive's controller that holds the angle
  double ground_damping_n_m_s_per_rad{};
};

/// Instruments that measure torque and twist of every spring between a shaft's inertias.
struct TorsionGauges {
  bool fitted{};
  double torque_noise_rms_n_m{};
  double twist_noise_rms_rad{};
};

enum class TorsionKind : std::uint8_t { kNone, kInertias, kBeam };

struct Torsion {
  TorsionKind kind{TorsionKind::kNone};
  std::vector<TorsionInertia> inertias;  ///< with kInertias, one after the other
  std::size_t gear_at{};                 ///< which of them carries the gear
  double damping_ratio{};                ///< of every mode with stiffness
  TorsionGauges gauges;                  ///< with kInertias
};

struct Shaft {
  std::string name;
  bool is_beam{};
  LumpedShaft lumped;  ///< unless is_beam
  RotorConfig beam;    ///< if is_beam
  std::vector<Support> supports;
  Torsion torsion;
};

}  // namespace levitas::rotor

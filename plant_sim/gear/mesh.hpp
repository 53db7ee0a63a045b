#pragma once
// Force between the teeth of two meshing gears.
//
// Equation   d = delta + n (F0/k + h);   f = k(t) d max(0, 1 - h/|d|) + c delta' - F0 n
//            delta   relative displacement of the teeth in the plane, run-out and transmission
//                    error included; n unit vector along the line of action; F0 static load that
//                    delta counts from; h half the backlash; c acts only while the teeth touch,
//                    and where they have room to part (h > 0) never so far that they would pull.
//            isotropic       all of delta counts: the complex model of the transverse vibration
//            line_of_action  only its component along n does: spur gears without friction
//            Friction adds mu N s(t) along j n; s changes sign at the pitch point.
//            docs/derivations.md (G1)-(G7).
// Sources    Ozguven & Houser (1988), review of gear dynamics; Kahraman & Singh (1991), backlash;
//            Vaishya & Singh (2001), friction; Chaari et al. (2009), cracked tooth.
// Frame      r = x + j y; f acts on the driven gear, -f on the driving one.
// Thread     any; pure functions, nothing allocated.
// Not done   torque of the tooth friction, contact ratio above one, helical gears.

#include <cstdint>
#include <vector>

#include "plant_sim/gear/transmission_error.hpp"

namespace levitas::gear {

enum class Direction : std::uint8_t { kIsotropic, kLineOfAction };

/// k(t) = k [1 + sum a cos(order x mesh angle + phase)]
struct StiffnessHarmonic {
  int order{1};
  double relative_amplitude{};
  double phase_rad{};
};

/// One tooth that carries less: k(t) falls by `depth` while it is in mesh, once per turn.
struct ToothCrack {
  bool on_driven{};
  int tooth{};     ///< 0: in mesh at angle 0
  double depth{};  ///< [1] share of k lost at its deepest
};

struct MeshLaw {
  Direction direction{Direction::kIsotropic};
  Vector normal{0.0, 1.0};  ///< n, unit vector from the driven towards the driving gear's motion
  double stiffness_n_per_m{};
  double damping_n_s_per_m{};
  double preload_n{};        ///< F0
  double half_backlash_m{};  ///< h
  double friction{};         ///< mu
  std::vector<StiffnessHarmonic> variation;
  std::vector<ToothCrack> cracks;
  int driving_teeth{1};
  int driven_teeth{1};
};

/// Where the wheels stand: angles of driving and driven wheel, and the tooth engagement.
struct Engagement {
  Vector mesh{1.0, 0.0};  ///< exp(j teeth x angle)
  double driving_rad{};
  double driven_rad{};  ///< of the driven wheel, counted in its own sense of rotation
};

/// Present stiffness over its mean value.
[[nodiscard]] double StiffnessFactor(const MeshLaw& law, const Engagement& at) noexcept;

/// Unit vector along the line of action of gears whose centres lie on the x axis: sin a + j cos a.
[[nodiscard]] Vector LineOfAction(double pressure_angle_rad) noexcept;

/// Force on the driven gear [N] for the relative displacement and its rate.
[[nodiscard]] Vector MeshForce(const MeshLaw& law, const Engagement& at, const Vector& delta_m,
                               const Vector& rate_m_per_s) noexcept;

/// The linear law about delta = 0: stiffness along n and across it, and the damping that goes
/// along.
struct LinearMesh {
  double normal_n_per_m{};
  double tangential_n_per_m{};
  double normal_n_s_per_m{};
  double tangential_n_s_per_m{};
};
[[nodiscard]] LinearMesh Linearise(const MeshLaw& law) noexcept;

}  // namespace levitas::gear

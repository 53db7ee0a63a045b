#pragma once
// The effects of a rig as the time step needs them: numbers at the present strength.
//
// Built      once per PlantModel (shapes, places in the state vector), then refreshed without
//            allocation whenever a strength changes.
// States     behind the nominal ones, so that gains designed for a nominal state vector fit its
//            front: per axis hysteresis z [1] and eddy lags [A]; per housing x, y, vx, vy [m, m/s].
// Units, frame  as PlantModel. Equations: docs/effects.md.
// Thread     constant while a plant advances.

#include <array>
#include <complex>
#include <limits>
#include <vector>

#include "common/axes.hpp"
#include "plant_sim/support/touchdown.hpp"

namespace levitas::plant {

inline constexpr std::size_t kNoState = std::numeric_limits<std::size_t>::max();

struct MagnetEffects {
  double gain{1.0};            ///< of the control current
  double command_offset_a{};   ///< added to the command of the control current
  double stiffness_n_per_m{};  ///< added to ks
  double towards{1.0};         ///< factors on the two coil currents
  double away{1.0};
  double per_knee_1_per_a{};  ///< 0 = no saturation
  double knee_exponent{1.0};
  double hysteresis_width_a{};
  double hysteresis_shape{};
  double eddy_tau_s{};
  double eddy_a_per_m{};  ///< share of ks/ki: the current whose lag is that of 1 m
  std::size_t hysteresis_state{kNoState};
  std::size_t eddy_state{kNoState};
};

struct BearingEffects {
  std::array<MagnetEffects, 2> axis;
  double cosine{1.0};  ///< of the angle by which the magnet's axes are turned
  double sine{};
  double coupling{};  ///< force across the control current per force along it
  std::vector<support::Touchdown> rubs;
  double housing_mass_kg{};  ///< 0 = it does not move
  double housing_rad_per_s{};
  double housing_damping_ratio{};
  std::size_t housing_state{kNoState};
};

struct ReadingEffects {
  double a2_1_per_m{};
  double a3_1_per_m2{};
  double gain{1.0};  ///< includes the sensor's own
  double bandwidth_hz{};
  double offset_m{};
  double noise_rms_m{};
  double noise_memory{};  ///< 0 = white
};

struct SensorTurn {
  double cosine{1.0};
  double sine{};
};

struct SensorRunout {
  std::size_t axis{};
  int order{};
  std::complex<double> amplitude_m;
};

struct Pickup {
  std::size_t axis{};
  double frequency_hz{};
  double amplitude_m{};
  double phase_rad{};
};

/// Force at a plane that turns at a multiple of rotation.
struct OrderForce {
  std::vector<double> shape;
  int order{};
  std::complex<double> force_n;
};

/// f = -[xx xy; yx yy] [x, y] at a plane.
struct PlaneSpring {
  std::vector<double> shape;
  double xx{}, xy{}, yx{}, yy{};  ///< [N/m]
};

struct RotatingDamper {
  std::vector<double> shape;  ///< zero for rigid modes: they do not bend the shaft
  double damping_n_s_per_m{};
};

struct Crack {
  std::vector<double> curvature;  ///< of every mode [1/m]
  double softening_n_m2{};        ///< c (E I)^2 [N m^3 per 1/m2]
  double cosine{1.0};             ///< direction of the crack in the rotor
  double sine{};
};

struct EffectModel {
  // What there is to do; all false for a rig without effects, and then nothing else is touched.
  bool magnets{};   ///< any BearingEffects differs from the nominal bearing
  bool memory{};    ///< any axis has hysteresis or eddy states
  bool housings{};  ///< any housing moves
  bool motions{};   ///< any force on the rotor below
  bool views{};     ///< any effect between the motion and the sensor's filter
  bool outputs{};   ///< any effect behind the sensor's filter
  std::vector<BearingEffects> bearings;
  std::array<ReadingEffects, kMaxAxes> readings;
  std::vector<SensorTurn> turns;  ///< per bearing
  std::vector<SensorRunout> runouts;
  std::vector<Pickup> pickups;
  std::vector<OrderForce> order_forces;
  std::vector<PlaneSpring> springs;
  std::vector<RotatingDamper> dampers;
  std::vector<Crack> cracks;
  std::vector<double> bow;  ///< w^2 b, real parts then imaginary parts; empty = straight
  std::complex<double> anisotropy;
  double drop_probability{};
  int drop_burst{1};
  double jitter_s{};
};

}  // namespace levitas::plant

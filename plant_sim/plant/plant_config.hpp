#pragma once
// Complete description of a simulated rig: parts and how they are arranged. SI units.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/axes.hpp"
#include "plant_sim/effect/effect_config.hpp"
#include "plant_sim/gear/gear_config.hpp"
#include "plant_sim/rotor/rotor_config.hpp"
#include "plant_sim/rotor/shaft_config.hpp"
#include "plant_sim/sensor/probe_point.hpp"

namespace levitas::plant {

/// Force of a magnet over a long stroke, as measured instead of derived from a gap squared:
/// F = f0 [ (i0+ic)^2 e^(-(s0-x)/d) - (i0-ic)^2 e^(-(far+x)/d) ]
struct ExponentialForce {
  double force_n_per_a2{};  ///< f0, extrapolated to a gap of 0
  double decay_m{};         ///< d
  double far_gap_m{};       ///< of the coil away from +x, the rotor centred; s0 is the other's
};

/// F(ic, x) = k [ ((i0+ic)/(s0-x))^2 - ((i0-ic)/(s0+x))^2 ],  ki = 4 k i0/s0^2, ks = 4 k i0^2/s0^3
struct MagnetConfig {
  double force_constant_n_m2_per_a2{};  ///< k
  double bias_current_a{};      ///< i0, design value (the commanded bias may differ in time)
  double gap_m{};               ///< s0
  double max_coil_current_a{};  ///< each coil within 0 .. this
  std::optional<ExponentialForce> exponential{};  ///< when there, it is the force, and k is unused
};

/// A coil on a voltage, without a current loop: what is commanded is the current that the voltage
/// would drive at last, u = gain x duty, and the coil's current follows by its inductance,
/// i' = (steady u(c) + offset - r i)/tau + emf i gap'/d,  tau = tau0 e^(-gap/d)/(1 + s i^2),
/// u and r as in plant_sim/amplifier/voltage_coil.hpp
struct VoltageDrive {
  double steady{1.0};        ///< current at last per current commanded; 1 = as calibrated
  double offset_a{};         ///< current at last without any command
  double time_constant_s{};  ///< tau0, extrapolated to a gap of 0
  double decay_m{};          ///< d
  double motion_emf{};       ///< share of the voltage that the moving rotor induces; 0 = none
  double dead_band_a{};      ///< the bridge takes this much from all that is commanded; 0 = none
  double curvature{};        ///< of u(c), which stays as it is at the dead band and at full duty
  double iron_1_per_a2{};    ///< s: inductance lost with the square of the current; 0 = none
  double warming_1_per_s{};  ///< resistance gained per second from the start of a run; 0 = none
  double away_steady_ratio{1.0};         ///< steady of the coil away from +x over the other's
  double away_time_constant_ratio{1.0};  ///< tau0 of that coil over the other's
};

struct AmplifierConfig {
  double bandwidth_hz{};                  ///< first-order current loop
  double slew_a_per_s{};                  ///< limit of |d ic/dt|; 0 = none
  int dac_bits{};                         ///< quantisation of ic over +- max_coil_current; 0 = none
  std::optional<VoltageDrive> voltage{};  ///< when there, it takes the place of the current loop
};

enum class SensorFilter : std::uint8_t { kFirstOrder, kButterworth2 };

struct SensorConfig {
  double bandwidth_hz{};  ///< -3 dB
  double noise_rms_m{};   ///< white, per sample
  int adc_bits{};         ///< 0 = no quantisation
  double range_m{};       ///< converter covers +- range, clips beyond
  double gain{1.0};       ///< reading per displacement; 1 = as calibrated
  SensorFilter filter{SensorFilter::kFirstOrder};
  std::vector<sensor::ProbePoint>
      characteristic;  ///< static curve before the filter; empty = a straight
};

/// Touchdown (retainer) bearing at the actuator plane.
struct TouchdownConfig {
  double clearance_m{};  ///< radial
  double stiffness_n_per_m{};
  double damping_n_s_per_m{};
  double friction{};          ///< Coulomb coefficient, on the sliding surface
  double journal_radius_m{};  ///< for the sliding speed of a rotating shaft
};

struct BearingConfig {
  std::string name;     ///< "de": its axes are de_x, de_y
  std::size_t shaft{};  ///< which of PlantConfig::shafts it carries; 0 for a rig with one rotor
  double actuator_z_m{};
  double sensor_z_m{};
  MagnetConfig magnet;
  AmplifierConfig amplifier;
  SensorConfig sensor;
  TouchdownConfig touchdown;
  bool x_only{};  ///< no coils and no probe in y, where a guide holds the rotor; a lone bearing's
};

struct UnbalanceMass {
  double z_m{};
  double moment_kg_m{};  ///< mass times eccentricity
  double phase_rad{};
  std::size_t shaft{};  ///< which of PlantConfig::shafts it sits on
};

struct DriveConfig {
  double max_acceleration_rad_per_s2{};
  double coast_down_1_per_s{};     ///< without torque the speed decays as d omega/dt = -c omega ...
  double coast_down_rad_per_s2{};  ///< ... - this (dry friction) until it stands
  double
      polar_inertia_kg_m2{};  ///< of all that turns, as the first shaft feels it; contact friction
                              ///< brakes it. 0: unknown, and contact does not change the speed
};

struct PlantConfig {
  std::int64_t period_ns{};
  double delay_samples{};    ///< sampling instant -> current command acts; fractions allowed
  rotor::RotorConfig rotor;  ///< the one rotor; unused when there are shafts
  std::vector<rotor::Shaft> shafts;  ///< geared rig: the first is driven, gears turn the others
  std::vector<gear::GearPair> gears;
  std::vector<BearingConfig> bearings;
  std::vector<UnbalanceMass> unbalance;
  double gravity_m_per_s2{};
  double gravity_direction_rad{};  ///< in the x-y plane, from +x towards +y
  DriveConfig drive;
  AxisArray sensor_polarity{};                ///< +1 or -1 per axis: how the probe is wired
  AxisArray actuator_polarity{};              ///< +1 or -1 per axis: how the coils are wired
  int substeps{};                             ///< fixed integration steps per period
  std::vector<effect::EffectConfig> effects;  ///< what the rig does beyond all this
};

}  // namespace levitas::plant

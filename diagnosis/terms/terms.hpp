#pragma once
// Everything a rig may differ by, place by place. Each list is complete for a rig with radial
// bearings; what cannot act in it (orders without rotation) has sensitivities of zero and drops out
// by itself.
//
// Definitions  as in docs/effects.md: parameters have the meaning and the unit they have in a rig
//              file.
// Tolerances   what a rig that counts as healthy may differ by (Tolerances); 0 = not a nuisance.
// Thread       any.

#include <vector>

#include "diagnosis/rig_view.hpp"
#include "diagnosis/term.hpp"

namespace levitas::diagnosis {

/// Standard deviations of what a healthy rig may differ by from its file.
struct Tolerances {
  double current_gain{0.03};            ///< ki, per axis
  double displacement_stiffness{0.03};  ///< ks, per axis
  double amplifier_bandwidth{0.05};
  double sensor_gain{0.01};
  double sensor_bandwidth{0.05};
  double sensor_offset_m{10e-6};
  double sensor_position_m{0.5e-3};
  double sensor_runout_m{1e-6};  ///< once per turn, each of cosine and sine
  double delay_samples{0.05};
  double modal_frequency{0.01};
  double modal_damping{0.3};
  double modal_shape{0.02};  ///< of the rms of the shape, at sensors and magnets
  double rotor_mass{0.005};
  double gyroscopic_inertia{0.02};
  double unbalance_kg_m{3e-6};  ///< each of cosine and sine, per plane
  double static_load_n{1.0};    ///< per axis
  // Geared shafts.
  double shaft_stiffness{0.02}, shaft_damping{0.2};
  double mesh_stiffness{0.03}, mesh_damping{0.2};
  double transmission_error_m{0.3e-6};  ///< each of cosine and sine, per order
  double gear_runout_m{1e-6};           ///< each of cosine and sine, per wheel
};

/// [s] time constant of an axis' sensor.
[[nodiscard]] double SensorLag(const RigView& rig, std::size_t axis);

[[nodiscard]] std::vector<Term> MagnetTerms(const RigView& rig, const Tolerances& tolerances);
[[nodiscard]] std::vector<Term> MagnetMemoryTerms(const RigView& rig);
[[nodiscard]] std::vector<Term> TimingTerms(const RigView& rig, const Tolerances& tolerances);
[[nodiscard]] std::vector<Term> SensorTerms(const RigView& rig, const Tolerances& tolerances);
[[nodiscard]] std::vector<Term> RotorTerms(const RigView& rig, const Tolerances& tolerances);
[[nodiscard]] std::vector<Term> RotatingTerms(const RigView& rig, const Tolerances& tolerances);
[[nodiscard]] std::vector<Term> ExternalTerms(const RigView& rig, const Tolerances& tolerances,
                                              double largest_orbit_m);
/// Teeth, wheels and shafts; empty for a rig with one rotor.
[[nodiscard]] std::vector<Term> GearTerms(const RigView& rig, const Tolerances& tolerances);

/// Pickup with a phase of its own in every record: only the lines that a record shows.
[[nodiscard]] std::vector<Term> MainsTerms(const RigView& rig,
                                           const std::vector<double>& frequencies_hz,
                                           std::size_t records);

/// All of them but the mains, in that order.
[[nodiscard]] std::vector<Term> AllTerms(const RigView& rig, const Tolerances& tolerances,
                                         double largest_orbit_m);

}  // namespace levitas::diagnosis

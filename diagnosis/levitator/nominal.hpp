#pragma once
// The numbers of the rig file that the models need. Thread: plain data.

#include <Eigen/Core>

#include "configuration/rig_file.hpp"
#include "diagnosis/levitator/origin.hpp"

namespace levitas::levitator {

struct NominalRig {
  double period_s{};
  double delay_samples{};
  double full_a{};  ///< what full duty drives at last
  double steady{}, offset_a{}, time_constant_s{}, inductance_decay_m{}, motion_emf{};
  double gap_m{};      ///< of the upper coil at x = 0
  double far_gap_m{};  ///< of the lower coil there
  double force_n_per_a2{}, force_decay_m{};
  double mass_kg{}, gravity_m_per_s2{};
  double noise_m{};         ///< of a reading, quantisation included
  Theta origin = Zeros(0);  ///< what is known to differ from all of these
  /// Covariance of the common values about the origin, as healthy records leave it; empty without.
  Eigen::MatrixXd known;
};

[[nodiscard]] inline NominalRig NominalOf(const configuration::RigFile& file) {
  const plant::PlantConfig& rig = file.plant;
  const plant::BearingConfig& bearing = rig.bearings.at(0);
  const plant::VoltageDrive& coil = bearing.amplifier.voltage.value();
  const plant::ExponentialForce& force = bearing.magnet.exponential.value();
  NominalRig out;
  out.period_s = static_cast<double>(rig.period_ns) * 1e-9;
  out.delay_samples = rig.delay_samples;
  out.full_a = bearing.magnet.max_coil_current_a;
  out.steady = coil.steady;
  out.offset_a = coil.offset_a;
  out.time_constant_s = coil.time_constant_s;
  out.inductance_decay_m = coil.decay_m;
  out.motion_emf = coil.motion_emf;
  out.gap_m = bearing.magnet.gap_m;
  out.far_gap_m = force.far_gap_m;
  out.force_n_per_a2 = force.force_n_per_a2;
  out.force_decay_m = force.decay_m;
  out.mass_kg = rig.rotor.given ? rig.rotor.given->mass_kg : 0.0;
  out.gravity_m_per_s2 = rig.gravity_m_per_s2;
  out.noise_m = bearing.sensor.noise_rms_m;
  out.origin = OriginOf(file);
  return out;
}

}  // namespace levitas::levitator

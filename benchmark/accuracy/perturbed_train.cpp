#include "benchmark/accuracy/perturbed_train.hpp"

#include <algorithm>
#include <complex>

namespace levitas::accuracy {

void Spoil(plant::PlantConfig& rig, const TrainMismatch& off, Random& random) {
  const auto by = [&random](double deviation) {
    return deviation * std::clamp(random.Normal(), -2.0, 2.0);
  };
  const auto move = [&by](double& amplitude_m, double& phase_rad, double deviation_m) {
    const std::complex<double> moved =
        std::polar(amplitude_m, phase_rad) + std::complex<double>(by(deviation_m), by(deviation_m));
    amplitude_m = std::abs(moved);
    phase_rad = std::arg(moved);
  };
  for (rotor::Shaft& shaft : rig.shafts) {
    const double stiffer = 1.0 + by(off.shaft_stiffness);
    shaft.lumped.kll_n_per_m *= stiffer;
    shaft.lumped.kla_n *= stiffer;
    shaft.lumped.kaa_n_m *= stiffer;
    shaft.lumped.damping_n_s_per_m *= 1.0 + by(off.shaft_damping);
  }
  for (gear::GearPair& pair : rig.gears) {
    pair.stiffness_n_per_m *= 1.0 + by(off.mesh_stiffness);
    pair.damping_n_s_per_m *= 1.0 + by(off.mesh_damping);
    for (gear::Harmonic& h : pair.transmission_error) {
      move(h.amplitude_m, h.phase_rad, off.transmission_error_m);
    }
    for (gear::Wheel* wheel : {&pair.driving, &pair.driven}) {
      move(wheel->runout_m, wheel->runout_phase_rad, off.gear_runout_m);
    }
  }
}

}  // namespace levitas::accuracy

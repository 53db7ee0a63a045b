#pragma once
// What the simulation's fixed time step costs in accuracy on this rig, with this law.
//
// Method   the closed loop runs twice from the same release (a tenth of the clearance, at the given
//          speed, unbalance and gravity acting), once with the rig's substeps and once with eight
//          times as many; compared are the positions that the sensors show, every period. Noise and
//          converters are left out: a last bit that falls the other way is no error of the step.
// Reading  the scheme's error falls with the square of the step (docs/derivations.md), so a step
//          eight times finer has 1/64 of it, and the difference is the error but for 2 %.
// Cost     nine times the simulated second: about 0.1 s of one core for eight modes per plane; with
//          more than 16 modes a shorter time is simulated.
// Failure  a loop that does not hold the rotor gives numbers that are large or not finite.
// Thread   any.

#include "controller/law/law_config.hpp"
#include "plant_sim/plant/plant_config.hpp"

namespace levitas::analysis {

struct StepError {
  int substeps{};
  int compared_with{};
  double duration_s{};
  double speed_rad_per_s{};
  double largest_m{};  ///< difference of any axis at any sample
  double peak_m{};     ///< of any axis' own motion

  [[nodiscard]] double Share() const noexcept { return peak_m > 0.0 ? largest_m / peak_m : 0.0; }
};

[[nodiscard]] StepError MeasureStepError(const plant::PlantConfig& rig, const law::LawConfig& law,
                                         double speed_rad_per_s);

}  // namespace levitas::analysis

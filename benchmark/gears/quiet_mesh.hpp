#pragma once
// A geared rig at a steady speed without current, with its law, and with blocks of synchronous
// control besides: what its shafts do, what they put on the housing, how their torsion varies.
//
// Blocks   of either target at the orders of both shafts and at those harmonics of the teeth that
//          the coils reach: all whose block still acts after it has settled. Others are left out
//          from the highest down, and said.
// Figures  of one second, without its mean: rms of the displacement at all probes, of the force of
//          each shaft on the housing and of the torque of each shaft's spring, from the plant's
//          state (plant_sim/plant/shaft_loads.hpp), not from what a probe reads.
// Units    SI. Thread: any; seconds a trial. Failure: BadInput of a rig without gears.

#include <string>
#include <vector>

#include "configuration/rig_file.hpp"

namespace levitas::gears {

struct Quiet {
  double displacement_m{};         ///< rms
  std::vector<double> housing_n;   ///< rms, per shaft, both directions
  std::vector<double> torque_n_m;  ///< rms, as `twisted`
  std::vector<double> orders;      ///< of the blocks that acted
  std::string trouble;             ///< a fault, in words; empty: none
};

struct QuietMesh {
  double speed_rad_per_s{};
  std::vector<std::string> twisted;  ///< "motor to pinion"
  Quiet off, law;
  Quiet still;  ///< blocks of target vibration
  Quiet soft;   ///< blocks of target current
};

/// Throws BadInput for a rig that this bench says nothing of.
void RefuseWithoutGears(const configuration::RigFile& rig);

[[nodiscard]] QuietMesh Listen(const configuration::RigFile& rig,
                               const configuration::ControllerFile& controller,
                               double speed_rad_per_s);

/// 20 log10(now / before).
[[nodiscard]] double Decibel(double now, double before);

}  // namespace levitas::gears

#pragma once
// How much of a torque impact the bearings of a geared rig can take off the teeth at best: a bound
// for any compensation, whatever it measures.
//
// Method   the rig turns steadily with its law and is hit. Test currents, pulses of kPulse periods
//          on every axis, are added to the law's such that the squares of the torque that passes
//          through the teeth become least, each pulse within what the impact itself leaves of the
//          coils' current. The rig's answer to a pulse is taken from the nonlinear rig once for
//          each axis and shifted; the pulses found are then played on it.
// Bounds   `foreseen` knows the impact kLeadS before it comes. `answered` begins kAnswer periods
//          after it, and knows at once how large it is and how long it lasts: no law does better.
// Figures  largest deviation of each shaft's torque from the run without impact [N m]; largest
//          control current [A]. Units SI. Thread: any; seconds. Failure: BadInput of a rig without
//          gears or without torsion.

#include <string>
#include <vector>

#include "configuration/rig_file.hpp"

namespace levitas::gears {

struct Impact {
  double torque_n_m{4.0};  ///< on the last inertia of the last shaft, as a load
  double duration_s{0.002};
};

struct Passed {
  std::vector<double> torque_n_m;  ///< as ImpactRelief::twisted
  double current_a{};              ///< largest of an axis
  bool saturated{};                ///< a current was at its limit
};

struct ImpactRelief {
  std::vector<std::string> twisted;  ///< "motor to pinion": the first is what the teeth pass on
  Passed law, answered, foreseen;
};

[[nodiscard]] ImpactRelief Relieve(const config::RigFile& rig,
                                   const config::ControllerFile& controller, double speed_rad_per_s,
                                   const Impact& impact);

}  // namespace levitas::gears

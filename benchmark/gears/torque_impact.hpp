#pragma once
// How much of a torque impact currents beside the law's can keep from passing through the teeth of
// a geared rig, whatever it is that would find them.
//
// Method   the rig turns steadily with its law and is hit. Test currents, pulses of half a
//          millisecond on every axis, are added to the law's such that the squares of the torque
//          that the teeth pass on, summed over 80 ms, become least; each within what the law
//          leaves of its coil's current meanwhile. The rig's answer to a pulse is taken from the
//          nonlinear rig once for each axis and shifted; the pulses found are then played on it.
// Knowing  `foreseen` begins 10 ms before the impact. `answered` begins two periods after it, when
//          a reading that shows it could be answered, and knows at once how large it is and how
//          long it lasts.
// No bound the squares are least, not the peak; what the law answers to the pulses is not limited
//          beforehand, only by the coils, and said by `saturated`.
// Figures  largest deviation of each shaft's torque from the run without impact [N m]; largest
//          control current [A]. Units SI. Thread: any; seconds. Failure: BadInput of a rig without
//          gears or torsion, for a speed beyond its drive, and where it trips with its law alone.

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
  bool tripped{};                  ///< the added currents threw the rotor out
};

struct ImpactRelief {
  std::vector<std::string> twisted;  ///< "motor to pinion": the first is what the teeth pass on
  Passed law, answered, foreseen;
};

[[nodiscard]] ImpactRelief Relieve(const configuration::RigFile& rig,
                                   const configuration::ControllerFile& controller,
                                   double speed_rad_per_s, const Impact& impact);

}  // namespace levitas::gears

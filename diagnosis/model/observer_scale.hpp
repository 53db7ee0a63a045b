#pragma once
// How far the parameters in force make the model's sensors and modes read larger than the rig
// file's, and the observer's gain divided by it.
//
// Why     a gain that stays while the readings per state grow makes a faster observer, which lets
//         more noise through than the gain was designed for, and one that shrinks with them a
//         slower one: data would prefer a scale for the noise alone. Divided, only what the model
//         predicts can identify the scales.
// Scales  readings: the sensor's gain over the file's. modes: of one plane, the readings per modal
//         displacement, sum_a h (h + dh) / sum_a h^2 over the plane's sensors.
//         K'[row][axis] = K[row][axis] / (modes[row] readings[axis]); modes are at least 0.2.
// Thread  any; plain data.

#include <array>
#include <vector>

#include "diagnosis/model/model_run.hpp"

namespace levitas::diagnosis {

struct ObserverScale {
  ObserverScale() : readings{}, modes{} {
    readings.fill(1.0);
    modes.fill(1.0);
  }
  std::array<double, kMaxAxes> readings;
  std::array<double, 2 * kMaxModes> modes;  ///< x plane, then y plane

  [[nodiscard]] static ObserverScale Of(const RigView& rig, const std::vector<Term>& terms,
                                        const std::vector<double>& theta);
};

[[nodiscard]] ObserverGains Divided(const ObserverGains& gains, const ObserverScale& by,
                                    const RigView& rig);

}  // namespace levitas::diagnosis

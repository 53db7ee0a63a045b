#pragma once
// What terms of a harmonic of the rotation share: its two parts, and the angle at which it acts.

#include "diagnosis/model/sample_point.hpp"

namespace levitas::diagnosis {

/// Parameter of a harmonic: its part 0 or 1, which both enter linearly.
[[nodiscard]] inline const char* PartName(int part) { return part == 0 ? "cosine" : "sine"; }

/// [rad] in the middle of the period, where forces are evaluated.
[[nodiscard]] inline double MidAngle(const SamplePoint& m, double period_s) {
  return m.angle_rad + 0.5 * period_s * static_cast<double>(m.speed_rad_per_s);
}

}  // namespace levitas::diagnosis

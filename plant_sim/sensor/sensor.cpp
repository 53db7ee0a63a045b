#include "plant_sim/sensor/sensor.hpp"

#include <cmath>
#include <numbers>

namespace levitas::sensor {

FilterStep MakeFilterStep(double bandwidth_hz, double gain, double duration_s) {
  const double ratio = 2.0 * std::numbers::pi * bandwidth_hz * duration_s;
  const double gone = -std::expm1(-ratio);
  // Mean of the response to a ramp, (21); its series where the difference would cancel.
  const double end = ratio > 1e-4 ? 1.0 - gone / ratio : ratio / 2.0 - ratio * ratio / 6.0;
  return {1.0 - gone, gain * (gone - end), gain * end};
}

}  // namespace levitas::sensor

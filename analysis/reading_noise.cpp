#include "analysis/reading_noise.hpp"

#include <cmath>

namespace levitas::analysis {

double ReadingNoise(const plant::SensorConfig& sensor) {
  const double step_m =
      sensor.adc_bits > 0 ? 2.0 * sensor.range_m / std::ldexp(1.0, sensor.adc_bits) : 0.0;
  return std::sqrt(sensor.noise_rms_m * sensor.noise_rms_m + step_m * step_m / 12.0);
}

}  // namespace levitas::analysis

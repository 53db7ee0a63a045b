#include "plant_sim/amplifier/amplifier.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace levitas::amplifier {

double ConverterStep(double range, int bits) {
  return bits == 0 ? 0.0 : 2.0 * range / std::ldexp(1.0, bits);
}

CoilPair LimitedCommand(const Limits& limits, bool enabled, double control_a,
                        double bias_a) noexcept {
  if (!enabled) return {};
  if (limits.dac_step_a > 0.0) {
    control_a = std::round(control_a / limits.dac_step_a) * limits.dac_step_a;
  }
  const double towards = std::clamp(bias_a + control_a, 0.0, limits.max_coil_current_a);
  const double away = std::clamp(bias_a - control_a, 0.0, limits.max_coil_current_a);
  return {0.5 * (towards - away), 0.5 * (towards + away)};
}

Step MakeStep(double bandwidth_hz, double slew_a_per_s, double duration_s) {
  const double tau_s = 1.0 / (2.0 * std::numbers::pi * bandwidth_hz);
  return {std::exp(-duration_s / tau_s), duration_s, tau_s, slew_a_per_s};
}

double FollowSlewing(const Step& step, double now_a, double command_a) noexcept {
  const double error_a = command_a - now_a;
  // Above this error the first-order law would ask for more than the slew rate, (18).
  const double linear_a = step.slew_a_per_s * step.tau_s;
  if (std::abs(error_a) <= linear_a) return command_a - error_a * step.decay;
  const double slewing_s = (std::abs(error_a) - linear_a) / step.slew_a_per_s;
  if (slewing_s >= step.duration_s) {
    return now_a + std::copysign(step.slew_a_per_s * step.duration_s, error_a);
  }
  const double rest = std::exp(-(step.duration_s - slewing_s) / step.tau_s);
  return command_a - std::copysign(linear_a * rest, error_a);
}

}  // namespace levitas::amplifier

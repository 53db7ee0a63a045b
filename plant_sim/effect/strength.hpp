#pragma once
// How an effect of partial strength acts: the value of a parameter between neutral and full, and
// the strength over time.
//
// Equation   linear  neutral + s (v - neutral);  inverse  v/s;  geometric  own^(1-s) v^s;  fixed v
//            s(t) = strength clamp((t - at)/ramp, 0, 1)
// Thread     any; pure, no allocation.

#include <algorithm>
#include <cmath>

#include "plant_sim/effect/catalogue.hpp"

namespace levitas::effect {

/// `own` is the rig's value, used where neutral is kOwn. Strength 1 gives `value` exactly, strength
/// 0 gives the neutral value exactly.
[[nodiscard]] inline double AtStrength(const Parameter& parameter, double value, double own,
                                       double strength) noexcept {
  if (parameter.scaling == Scaling::kFixed || strength == 1.0) return value;
  const double neutral = std::isnan(parameter.neutral) ? own : parameter.neutral;
  if (strength == 0.0) return neutral;
  switch (parameter.scaling) {
    case Scaling::kInverse:
      return value / strength;
    case Scaling::kGeometric:
      return neutral * std::pow(value / neutral, strength);
    case Scaling::kLinear:
    case Scaling::kFixed:
      break;
  }
  return neutral + strength * (value - neutral);
}

/// Strength of an entry at a plant time.
[[nodiscard]] inline double StrengthAt(const EffectConfig& entry, double time_s) noexcept {
  if (time_s < entry.at_s) return 0.0;
  if (entry.ramp_s <= 0.0) return entry.strength;
  return entry.strength * std::min(1.0, (time_s - entry.at_s) / entry.ramp_s);
}

}  // namespace levitas::effect

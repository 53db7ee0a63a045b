#pragma once
// How fast an observer follows the readings: coarse and smooth, or seeing slow effects.

#include <array>

namespace levitas::diagnosis {

/// Process noise; the model must explain all motion beyond it.
struct ObserverSpeed {
  double force_noise_share;
  double force_drift_share;
};
inline constexpr ObserverSpeed kFast{0.01, 1e-4};
inline constexpr ObserverSpeed kSlow{0.001, 1e-6};

/// Slowest first: what every search begins with and, once it knows enough, returns to.
inline constexpr std::array kSpeeds{kSlow, ObserverSpeed{0.003, 1e-5}, kFast};

}  // namespace levitas::diagnosis

#pragma once
// Torque and twist of the couplings of geared shafts, measured beside the loop.
//
// Signs   torque M = k (theta_far - theta_near) and twist theta_far - theta_near, near being the
//         inertia that the rig file lists first. Both count from the loaded rest, as positions do:
//         the mean that the drive brings is not in them.
// Order   samples one after the other, of each all couplings in the order of the rig file.
// Units   N m, rad. `first_cycle` counts as SensorFrame::cycle does.
// Use     no law reads it: it is late by up to a batch, and a batch may be lost.

#include <array>
#include <cstdint>

namespace levitas {

inline constexpr std::size_t kMaxCouplings = 8;
inline constexpr std::size_t kTorsionSamples = 32;  ///< of a full batch

struct TorsionBatch {
  using Values = std::array<double, kMaxCouplings * kTorsionSamples>;
  std::uint64_t first_cycle{};
  std::uint32_t rig_session{};
  std::uint32_t couplings{};
  std::uint32_t samples{};
  Values torque_n_m{};
  Values twist_rad{};
};

}  // namespace levitas

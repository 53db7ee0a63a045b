#pragma once
// What the supervisor sees of one cycle, and a fault it may find in it. Plain data.
//
// Frame   bearing frame (polarity undone by the caller). Units: SI.

#include <cstdint>

#include "common/axes.hpp"
#include "common/enums.hpp"

namespace levitas::supervisor {

struct Observation {
  std::uint64_t cycle{};             ///< the controller's own count
  bool fresh{};                      ///< a new frame is there; else the rest is the last one's
  AxisArray position_m{};            ///< as read, may be out of range or not finite
  double speed_rad_per_s{};          ///< as read, may be not finite
  std::uint32_t rig_session{};       ///< changes when the rig restarts
  std::uint32_t rig_status{};        ///< RigStatus bits
  std::uint32_t held_currents{};     ///< periods in which the rig used an old current, its count
  std::uint32_t missed_deadlines{};  ///< periods skipped before this cycle
  std::uint16_t saturated_axes{};    ///< axes the law limited in the previous cycle
};

/// A fault with its evidence.
struct Finding {
  Fault fault{Fault::kNone};
  std::int8_t axis{-1};  ///< -1: not of one axis
  double value{};        ///< what was measured
  double limit{};        ///< what is allowed
};

/// The finding that tripped, kept until reset.
struct Latch {
  Finding finding;
  std::uint64_t cycle{};  ///< the controller's cycle that found it
};

}  // namespace levitas::supervisor

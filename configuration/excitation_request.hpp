#pragma once
// A test signal that is asked for while a run is under way, as YAML text:
//
//   kind: excitation
//   hold_s: 5
//   orbit_limit_um: 75          # 30 % of the clearance when left out
//   excitation:
//     - {channel: de_x, signal: chirp, amplitude_a: 0.2, from_hz: 10, to_hz: 400, repeat_s: 2}
//
// Keys      those of a step of a scenario, read by the same table; units and ranges as there.
// Bounds    besides: an end within kLongestHoldSeconds, at most kMostSignals, and multisines whose
//           tables together take the controller less than about a second to fill.
// Failure   BadInput with every problem at once.
// Thread    any but the loop's; allocates.

#include <cstdint>
#include <string>

#include "common/rig_numbers.hpp"
#include "controller/scenario/scenario_config.hpp"

namespace levitas::configuration {

inline constexpr double kLongestHoldSeconds = 3600.0;
inline constexpr std::size_t kMostSignals = 8;
/// Of one request, over all its signals: lines times samples of a period.
inline constexpr double kMostTableTerms = 5e7;
inline constexpr double kTermsPerSample = 20.0;  ///< what a sample costs besides its lines

/// A step that does nothing but excite. `name` stands for the file in messages.
[[nodiscard]] scenario::Step ParseExcitation(const std::string& text, const std::string& name,
                                             const RigNumbers& rig);

}  // namespace levitas::configuration

#pragma once
// How far in speed a run was shown, beside what the rig is rated for: a verdict holds up to there.
//
// Shown    largest |speed| that two frames in a row reach while the rotor is levitated and judged
//          (phase.hpp); zero where it only stood.
// Rated    the rig file's max_speed. A rig whose rated speed is no more than the controller's
//          standstill speed does not turn: it has no range.
// Whole    within 1 % of the rated speed, which is noise and steps of a converter, as in
//          controller/supervisor/speed_watch.hpp.
// Units    rad/s. Thread: any. Failure: none.

#include <string>

#include "common/rig_numbers.hpp"
#include "verdict/session_statistics.hpp"

namespace levitas::verdict {

struct SpeedRange {
  double shown_rad_per_s{};
  double rated_rad_per_s{};  ///< 0: the rig has none
  bool turns{};              ///< the rig is made to turn

  [[nodiscard]] bool Whole() const noexcept;
  [[nodiscard]] double Share() const noexcept;  ///< [1] shown of rated; 0 without a rated speed
};

[[nodiscard]] SpeedRange RangeOf(const RigNumbers& rig, const SessionFigures& session) noexcept;

/// "up to 3000 of 6000 rpm", "up to the rated 6000 rpm", "standing, 0 of 6000 rpm"; empty for a rig
/// that does not turn.
[[nodiscard]] std::string Text(const SpeedRange& range);

}  // namespace levitas::verdict

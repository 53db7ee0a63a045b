#include "verdict/speed_range.hpp"

#include <fmt/format.h>

#include "common/rotational_speed.hpp"

namespace levitas::verdict {

bool SpeedRange::Whole() const noexcept {
  constexpr double kReached = 0.99;
  return rated_rad_per_s > 0.0 && shown_rad_per_s >= kReached * rated_rad_per_s;
}

double SpeedRange::Share() const noexcept {
  return rated_rad_per_s > 0.0 ? shown_rad_per_s / rated_rad_per_s : 0.0;
}

SpeedRange RangeOf(const RigNumbers& rig, const SessionFigures& session) noexcept {
  const bool turns = rig.max_speed_rad_per_s > session.standstill_rad_per_s ||
                     session.levitated_speed_rad_per_s > 0.0;
  return {session.levitated_speed_rad_per_s, rig.max_speed_rad_per_s, turns};
}

std::string Text(const SpeedRange& range) {
  if (!range.turns) return {};
  const double shown_rpm = RadPerSToRpm(range.shown_rad_per_s);
  const double rated_rpm = RadPerSToRpm(range.rated_rad_per_s);
  if (range.Whole()) return fmt::format("up to the rated {:.0f} rpm", rated_rpm);
  if (!(range.rated_rad_per_s > 0.0)) return fmt::format("up to {:.0f} rpm", shown_rpm);
  if (range.shown_rad_per_s == 0.0) return fmt::format("standing, 0 of {:.0f} rpm", rated_rpm);
  return fmt::format("up to {:.0f} of {:.0f} rpm", shown_rpm, rated_rpm);
}

}  // namespace levitas::verdict

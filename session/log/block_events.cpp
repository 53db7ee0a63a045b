#include "session/log/block_events.hpp"

#include <fmt/format.h>

namespace levitas::session {
namespace {

constexpr std::string_view kSubject = "synchronous control ";
constexpr std::string_view kBegins = " begins at ";
constexpr std::string_view kEnds = " ends at ";
constexpr std::string_view kWhy = "): ";

std::string_view Text(synchronous::Ending ending) {
  using synchronous::Ending;
  switch (ending) {
    case Ending::kNone:
      break;
    case Ending::kSpeed:
      return "the speed left its window";
    case Ending::kAngleLost:
      return "the rotor's angle is lost";
    case Ending::kAngleJumped:
      return "the rotor's angle jumped";
    case Ending::kSaturated:
      return "an axis stays at its current limit; it begins again after the speed has left its "
             "window";
    case Ending::kOrbitGrew:
      return "the orbit grew";
    case Ending::kCurrentTooLarge:
      return "it needs more than its largest_current_a; it begins again after the speed has left "
             "its window";
    case Ending::kNotLevitated:
      return "the rotor is no longer held about its centre";
  }
  return "";
}

std::string_view Text(synchronous::AngleSource angle_from) {
  using synchronous::AngleSource;
  switch (angle_from) {
    case AngleSource::kRig:
      break;
    case AngleSource::kSpeed:
      return "no mark on the shaft, its angle is the integral of the measured speed";
    case AngleSource::kOrbit:
      return "no mark on the shaft, its angle is estimated from the orbit";
  }
  return "";
}

}  // namespace

std::string BlockBegins(std::string_view name, std::string_view where,
                        synchronous::AngleSource angle_from) {
  const std::string_view estimated = Text(angle_from);
  return fmt::format("{}{} begins {}{}{}", kSubject, name, where, estimated.empty() ? "" : ": ",
                     estimated);
}

std::string BlockEnds(std::string_view name, std::string_view where, synchronous::Ending why) {
  return fmt::format("{}{} ends {}: {}", kSubject, name, where, Text(why));
}

// Should a name hold " begins at " or " ends at " itself, the last of them is the sentence's own.
std::optional<BlockEvent> ReadBlockEvent(std::string_view text) {
  if (!text.starts_with(kSubject)) return std::nullopt;
  text.remove_prefix(kSubject.size());
  const auto ends = text.rfind(kEnds);
  const auto begins = text.rfind(kBegins);
  const bool ending =
      ends != std::string_view::npos && (begins == std::string_view::npos || ends > begins);
  const auto at = ending ? ends : begins;
  if (at == std::string_view::npos) return std::nullopt;
  BlockEvent event{std::string(text.substr(0, at)), !ending, {}};
  const auto why = text.find(kWhy, at);
  if (why != std::string_view::npos) event.why = text.substr(why + kWhy.size());
  return event;
}

}  // namespace levitas::session

#include "cli/commands/critical_speeds_text.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "common/rotational_speed.hpp"

namespace levitas::cli {

nlohmann::ordered_json CriticalSpeedsJson(const analysis::Campbell& campbell) {
  auto json = nlohmann::ordered_json::array();
  for (const auto& crossing : campbell.crossings) {
    json.push_back({{"speed_rpm", RadPerSToRpm(crossing.speed_rad_per_s)},
                    {"frequency_hz", crossing.mode.frequency_hz},
                    {"damping_ratio", crossing.mode.damping_ratio},
                    {"whirl", analysis::WhirlName(crossing.mode)},
                    {"excited_by", campbell.orders[crossing.order].name}});
  }
  return json;
}

void ShowCriticalSpeeds(const analysis::Campbell& campbell, const char* what,
                        nlohmann::ordered_json& json) {
  const double top_rpm = RadPerSToRpm(campbell.speeds.back().speed_rad_per_s);
  json["up_to_rpm"] = top_rpm;
  json["critical_speeds"] = CriticalSpeedsJson(campbell);
  fmt::print("{}, up to {:.0f} rpm:{}\n", what, top_rpm,
             campbell.crossings.empty() ? " nowhere" : "");
  for (const auto& crossing : campbell.crossings) {
    const double damping = crossing.mode.damping_ratio;
    const double amplification = analysis::AmplificationFactor(crossing.mode);
    fmt::print("{:>10.1f} rpm {:>10.3f} Hz  {}{}{}{}\n", RadPerSToRpm(crossing.speed_rad_per_s),
               crossing.mode.frequency_hz,
               damping == 0.0 ? "" : fmt::format("damping {:.5f}  ", damping),
               analysis::WhirlName(crossing.mode),
               campbell.orders.size() == 1 ? "" : "  " + campbell.orders[crossing.order].name,
               amplification >= analysis::kCriticallyDamped
                   ? ""
                   : fmt::format("  critically damped (amplification {:.1f})", amplification));
  }
}

}  // namespace levitas::cli

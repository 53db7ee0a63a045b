#include "cli/run/loop_warning.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <optional>

#include "analysis/poles.hpp"
#include "analysis/synchronous_loop.hpp"
#include "common/rotational_speed.hpp"

namespace levitas::cli {
namespace {

std::optional<analysis::LoopPoles> PolesAt(const configuration::RigFile& rig,
                                           const law::LawConfig& law, double speed_rad_per_s) {
  try {
    return analysis::ClosedLoopPoles(rig.plant, law, speed_rad_per_s);
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

}  // namespace

std::string UnstableLoop(const configuration::RigFile& rig, const law::LawConfig& law,
                         const std::vector<double>& speeds_rad_per_s, const std::string& rig_name,
                         const std::string& controller_name) {
  for (const double speed : speeds_rad_per_s) {
    const auto at = PolesAt(rig, law, speed);
    if (!at || at->stable) continue;
    const double rpm = RadPerSToRpm(speed);
    return fmt::format(
        "the loop of rig {} and this controller is unstable {}: {}. See amb poles --rig {} "
        "--controller {} --speed-rpm {:.0f}; amb design pid --rig {} --out FILE makes a law for "
        "it",
        rig.numbers.name, speed == 0.0 ? "at rest" : fmt::format("at {:.0f} rpm", rpm),
        analysis::WhyUnstable(*at), rig_name, controller_name, rpm, rig_name);
  }
  return {};
}

std::string UnstableBlocksOf(const configuration::RigFile& rig,
                             const configuration::ControllerFile& controller) {
  if (controller.synchronous.blocks.empty()) return {};
  try {
    return analysis::UnstableBlocks(rig.plant, controller.law, controller.synchronous);
  } catch (const std::exception& why) {
    return fmt::format("its synchronous blocks cannot be judged with this rig ({})", why.what());
  }
}

std::vector<double> ScenarioSpeeds(const scenario::ScenarioConfig& scenario) {
  double fastest = 0.0;
  for (const auto& step : scenario.steps) {
    fastest = std::max(fastest, std::abs(step.speed_rad_per_s));
  }
  if (fastest == 0.0) return {0.0};
  return {0.0, fastest};
}

}  // namespace levitas::cli

#include "cli/commands/bias_margins.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/sampled_loop.hpp"
#include "common/rotational_speed.hpp"

namespace levitas::cli {

std::vector<LoopAtBias> JudgeBias(const configuration::RigFile& rig,
                                  const configuration::ControllerFile& controller,
                                  const std::vector<analysis::SensitivityResult>& at_rig_bias) {
  constexpr int kSteps = 4;
  std::vector<LoopAtBias> loops;
  if (controller.bias.empty()) return loops;
  const double whole_a = rig.numbers.bias_current_a;
  const double ratio = controller.bias.lowest_current_a / whole_a;
  for (const analysis::SensitivityResult& whole : at_rig_bias) {
    loops.push_back({whole_a, whole});
    const double speed = whole.speed_rad_per_s;
    for (int k = 1; k <= kSteps; ++k) {
      const double bias_a = whole_a * std::pow(ratio, static_cast<double>(k) / kSteps);
      const auto loop = analysis::CloseLoopAtBias(rig.plant, controller.law, speed, bias_a);
      loops.push_back({bias_a, analysis::SensitivityPeaks(loop, speed)});
    }
  }
  return loops;
}

void PrintBias(const std::vector<LoopAtBias>& loops, const std::vector<std::string>& channels,
               nlohmann::ordered_json& json) {
  if (loops.empty()) return;
  fmt::print(
      "bias saving: the loop from the rig's bias to the lowest\n  {:>8}{:>10}{:>12}{:>9}{:>10}\n",
      "rpm", "bias A", "max |S|", "of", "zone");
  bool not_held = false;
  for (const LoopAtBias& at : loops) {
    const auto& axes = at.loop.axes;
    const auto worst = std::ranges::max_element(axes, {}, &analysis::AxisSensitivity::peak);
    const std::string& channel = channels[static_cast<std::size_t>(worst - axes.begin())];
    const std::string zone = at.loop.zone ? std::string(analysis::Name(*at.loop.zone)) : "no grade";
    const std::string trouble = !at.loop.point.failure.empty()
                                    ? fmt::format("  NOT HELD: {}", at.loop.point.failure)
                                : at.loop.stable ? ""
                                                 : "  UNSTABLE";
    // Of a loop that is not held no sensitivity can be told.
    const bool known = at.loop.point.failure.empty() && at.loop.stable;
    fmt::print("  {:>8.0f}{:>10.3f}{:>12}{:>9}{:>10}{}\n", RadPerSToRpm(at.loop.speed_rad_per_s),
               at.bias_a, known ? fmt::format("{:.3f}", worst->peak) : "-", known ? channel : "-",
               known ? zone : "-", trouble);
    json["bias_saving"].push_back(
        {{"speed_rpm", RadPerSToRpm(at.loop.speed_rad_per_s)},
         {"bias_current_a", at.bias_a},
         {"stable", at.loop.stable},
         {"sensitivity_peak",
          known ? nlohmann::ordered_json(worst->peak) : nlohmann::ordered_json()},
         {"channel", known ? nlohmann::ordered_json(channel) : nlohmann::ordered_json()},
         {"not_held_because", at.loop.point.failure}});
    not_held = not_held || !at.loop.point.failure.empty();
  }
  if (not_held) {
    fmt::print(
        "  where it is not held the bias does not fall to: it stays above what the currents of the "
        "last seconds ask for\n");
  }
}

}  // namespace levitas::cli

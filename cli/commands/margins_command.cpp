// amb margins: sensitivity peaks with their ISO 14839-3 zones, gain and phase margins.

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>

#include "analysis/sensitivity.hpp"
#include "cli/commands/command.hpp"
#include "cli/json_file.hpp"
#include "cli/options/analysis_options.hpp"
#include "cli/options/requirement.hpp"
#include "common/rotational_speed.hpp"
#include "session/output_path.hpp"

namespace levitas::cli {
namespace {

std::string Text(const std::optional<double>& value, double scale, const char* unit) {
  return value ? fmt::format("{:.2f}{}", *value * scale, unit) : "none";
}

std::string ZoneText(const std::optional<analysis::Zone>& zone) {
  return zone ? std::string(analysis::Name(*zone)) : "no grade";
}

constexpr double kDegrees = 180.0 / std::numbers::pi;

/// About which point of the nonlinear magnets the numbers hold.
void PrintPoint(const plant::OperatingPoint& point, const std::vector<std::string>& channels) {
  if (!point.failure.empty()) return;
  fmt::print("  static: ");
  for (std::size_t i = 0; i < channels.size(); ++i) {
    fmt::print("{}{} {:.3f} A at {:.1f} um", i == 0 ? "" : ", ", channels[i], point.control_a[i],
               1e6 * point.displacement_m[i]);
  }
  fmt::print("\n");
}

void Print(const analysis::SensitivityResult& at, const std::vector<std::string>& channels) {
  if (!at.point.failure.empty()) {
    fmt::print("{:.0f} rpm: NOT HELD: {}. No grade.\n", RadPerSToRpm(at.speed_rad_per_s),
               at.point.failure);
  } else if (at.stable) {
    fmt::print("{:.0f} rpm: STABLE, zone {}\n", RadPerSToRpm(at.speed_rad_per_s),
               ZoneText(at.zone));
  } else {
    fmt::print(
        "{:.0f} rpm: UNSTABLE (largest |z| {:.6f}): no grade. A sensitivity peak, however small, "
        "says nothing about a loop that does not settle.\n",
        RadPerSToRpm(at.speed_rad_per_s), at.largest_pole_modulus);
  }
  fmt::print("  {:<8}{:>9}{:>11}{:>11}{:>12}{:>12}{:>18}\n", "axis", "max |S|", "at Hz", "zone",
             "gain up", "gain down", "phase margin");
  for (std::size_t i = 0; i < at.axes.size(); ++i) {
    const auto& axis = at.axes[i];
    fmt::print("  {:<8}{:>9.3f}{:>11.2f}{:>11}{:>12}{:>12}{:>18}\n", channels[i], axis.peak,
               axis.frequency_hz, ZoneText(axis.zone), Text(axis.margins.gain_up, 1.0, ""),
               Text(axis.margins.gain_down, 1.0, ""),
               Text(axis.margins.phase_rad, kDegrees, " deg"));
  }
  fmt::print("  {:<8}{:>9.3f}{:>11.2f}   largest singular value of S\n", "all",
             at.largest_singular_value, at.largest_singular_value_hz);
  PrintPoint(at.point, channels);
}

nlohmann::ordered_json Number(const std::optional<double>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json ZoneJson(const std::optional<analysis::Zone>& zone) {
  return zone ? nlohmann::ordered_json(std::string(analysis::Name(*zone)))
              : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json Json(const analysis::SensitivityResult& at,
                            const std::vector<std::string>& channels) {
  nlohmann::ordered_json json;
  json["speed_rpm"] = RadPerSToRpm(at.speed_rad_per_s);
  json["stable"] = at.stable;
  json["largest_pole_modulus"] = at.largest_pole_modulus;
  json["zone"] = ZoneJson(at.zone);
  json["not_held_because"] = at.point.failure;
  for (std::size_t i = 0; i < at.axes.size(); ++i) {
    const auto& axis = at.axes[i];
    json["axes"].push_back({{"channel", channels[i]},
                            {"sensitivity_peak", axis.peak},
                            {"frequency_hz", axis.frequency_hz},
                            {"zone", ZoneJson(axis.zone)},
                            {"static_current_a", at.point.control_a[i]},
                            {"static_position_m", at.point.displacement_m[i]},
                            {"gain_margin_up", Number(axis.margins.gain_up)},
                            {"gain_margin_down", Number(axis.margins.gain_down)},
                            {"phase_margin_rad", Number(axis.margins.phase_rad)},
                            {"phase_margin_at_hz", Number(axis.margins.phase_at_hz)}});
  }
  json["largest_singular_value"] = at.largest_singular_value;
  json["largest_singular_value_hz"] = at.largest_singular_value_hz;
  return json;
}

ExitStatus Run(const AnalysisOptions& options, const std::string& required) {
  session::CheckOutputPath(options.json_path, {});
  const auto [rig, controller, delay] = LoadLoop(options);
  nlohmann::ordered_json json =
      LoopJson(rig.numbers, controller, rig.plant.delay_samples * rig.numbers.period_s());
  fmt::print("Sensitivity of the sampled loop, delay included; zones of ISO 14839-3\n");
  fmt::print("rig {}, controller {}\n{}", rig.numbers.name, ControllerText(controller), delay);
  std::vector<analysis::SensitivityResult> loops;
  for (const double rpm : options.speeds_rpm) {
    const auto& result = loops.emplace_back(
        analysis::SensitivityPeaks(rig.plant, controller.file.law, RpmToRadPerS(rpm)));
    Print(result, rig.numbers.channels);
    json["speeds"].push_back(Json(result, rig.numbers.channels));
  }
  fmt::print("{}", GainsNote(options, rig));
  WriteJsonFile(options.json_path, json);
  RequireLoops(required, loops);
  return ExitStatus::kDone;
}

}  // namespace

void AddMarginsCommand(CLI::App& app, Action& action) {
  auto options = std::make_shared<AnalysisOptions>();
  CLI::App* command = app.add_subcommand(
      "margins", "Sensitivity peaks with ISO 14839-3 zones, gain and phase margins, over speed");
  AddRigOption(*command, *options);
  AddControllerOption(*command, *options);
  AddPortOption(*command, *options);
  AddSpeedOption(*command, *options, {0.0});
  auto required = std::make_shared<std::string>();
  AddLoopRequirement(*command, *required);
  AddJsonOption(*command, *options);
  command->callback([options, required, &action] {
    action = [options, required] { return Run(*options, *required); };
  });
}

}  // namespace levitas::cli

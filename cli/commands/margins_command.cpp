// amb margins: sensitivity peaks with their ISO 14839-3 zones, gain and phase margins.

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>

#include "analysis/sensitivity.hpp"
#include "analysis/synchronous_loop.hpp"
#include "cli/commands/angle_note.hpp"
#include "cli/commands/bias_margins.hpp"
#include "cli/commands/command.hpp"
#include "cli/json_file.hpp"
#include "cli/options/analysis_options.hpp"
#include "cli/options/requirement.hpp"
#include "cli/options/svg_option.hpp"
#include "common/rotational_speed.hpp"
#include "design/drawn_rigs/rig_uncertainty.hpp"
#include "report/rig/margins_picture.hpp"
#include "session/log/output_path.hpp"

namespace levitas::cli {
namespace {

struct MarginsOptions : AnalysisOptions {
  std::string required;
  std::string svg_path;
};

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

/// Blocks of synchronous control over their windows: the file's rig, and the worst of rigs drawn
/// within its tolerances.
struct BlocksAt {
  analysis::SynchronousJudgement rig;
  double worst_decay{1.0};
  double worst_modulus{};
  int not_held{};  ///< drawn rigs that the law alone does not hold: no part of the worst
};

std::vector<BlocksAt> JudgeBlocks(const configuration::RigFile& rig,
                                  const configuration::ControllerFile& file) {
  constexpr std::size_t kSpeeds = 9;
  constexpr std::size_t kDrawn = 10;
  constexpr std::size_t kModes = 4;
  const auto drawn =
      uncertainty::DrawRigs(rig, uncertainty::FromTolerances(rig, kModes), kDrawn, 1);
  std::vector<BlocksAt> all;
  for (const double speed :
       analysis::JudgedSpeeds(file.synchronous, kSpeeds, analysis::TableSpeeds::kLeftOut)) {
    BlocksAt& at = all.emplace_back();
    at.rig = analysis::JudgeSynchronous(analysis::CloseLoop(rig.plant, file.law, speed),
                                        file.synchronous, speed);
    for (const configuration::RigFile& other : drawn) {
      const auto loop = analysis::CloseLoop(other.plant, file.law, speed);
      if (!(analysis::LargestPoleModulus(loop) < 1.0)) {  // not the blocks' fault
        ++at.not_held;
        continue;
      }
      const auto judged = analysis::JudgeSynchronous(loop, file.synchronous, speed);
      at.worst_modulus = std::max(at.worst_modulus, judged.largest_pole_modulus);
      for (const auto& block : judged.blocks) {
        if (block.acts) at.worst_decay = std::min(at.worst_decay, block.slowest_decay);
      }
    }
  }
  return all;
}

void PrintBlocks(const std::vector<BlocksAt>& blocks, const configuration::ControllerFile& file,
                 nlohmann::ordered_json& json) {
  fmt::print(
      "synchronous control: decay of each block (1: as its time constant, below 0: grows){}\n",
      AngleNote(file.synchronous));
  fmt::print("  {:>8}", "rpm");
  for (const auto& block : file.synchronous.blocks) fmt::print("{:>16}", block.name);
  fmt::print("{:>12}{:>16}{:>14}\n", "largest |z|", "worst of drawn", "its |z|");
  for (const BlocksAt& at : blocks) {
    fmt::print("  {:>8.0f}", RadPerSToRpm(at.rig.speed_rad_per_s));
    nlohmann::ordered_json row{{"speed_rpm", RadPerSToRpm(at.rig.speed_rad_per_s)},
                               {"stable", at.rig.stable()},
                               {"largest_pole_modulus", at.rig.largest_pole_modulus},
                               {"worst_decay_of_drawn", at.worst_decay},
                               {"worst_pole_modulus_of_drawn", at.worst_modulus},
                               {"drawn_rigs_not_held", at.not_held}};
    for (std::size_t k = 0; k < at.rig.blocks.size(); ++k) {
      const auto& block = at.rig.blocks[k];
      fmt::print("{:>16}", block.acts ? fmt::format("{:.3f}", block.slowest_decay) : "-");
      if (!block.acts) continue;
      row["blocks"].push_back(
          {{"name", file.synchronous.blocks[k].name}, {"slowest_decay", block.slowest_decay}});
    }
    fmt::print("{:>12.6f}{:>16.3f}{:>14.6f}{}\n", at.rig.largest_pole_modulus, at.worst_decay,
               at.worst_modulus, at.rig.stable() ? "" : "  UNSTABLE");
    if (at.not_held > 0) {
      fmt::print("  {} of the drawn rigs are not held by the law alone, and not counted here\n",
                 at.not_held);
    }
    json["synchronous"].push_back(row);
  }
}

/// What the picture draws, so that another program can.
nlohmann::ordered_json CurvesJson(const report::LoopAtSpeed& loop,
                                  const std::vector<std::string>& channels) {
  nlohmann::ordered_json json;
  json["speed_rpm"] = RadPerSToRpm(loop.peaks.speed_rad_per_s);
  json["frequency_hz"] = loop.curves.frequency_hz;
  for (std::size_t i = 0; i < loop.curves.axes.size(); ++i) {
    nlohmann::ordered_json axis{{"channel", channels[i]}};
    for (const auto value : loop.curves.axes[i]) {
      axis["sensitivity_real"].push_back(value.real());
      axis["sensitivity_imaginary"].push_back(value.imag());
    }
    json["axes"].push_back(std::move(axis));
  }
  return json;
}

/// Written only when there is a picture: curves make the JSON a hundred times longer.
void Draw(const MarginsOptions& options, const AnalysedLoop& of,
          const std::vector<analysis::SensitivityResult>& loops, nlohmann::ordered_json& json) {
  if (options.svg_path.empty()) return;
  std::vector<report::LoopAtSpeed> rows;
  for (const auto& loop : loops) {
    rows.push_back(
        {loop, analysis::CurvesOf(of.rig.plant, of.controller.file.law, loop.speed_rad_per_s)});
    json["curves"].push_back(CurvesJson(rows.back(), of.rig.numbers.channels));
  }
  const std::string title =
      fmt::format("Rig {}, controller {}", of.rig.numbers.name, of.controller.file.name);
  svg::Write(options.svg_path, report::MarginsPicture(title, rows, of.rig.numbers.channels));
}

ExitStatus Run(const MarginsOptions& options) {
  const std::string& required = options.required;
  session::CheckOutputPath(options.json_path, {});
  session::CheckOutputPath(options.svg_path, {});
  const AnalysedLoop of = LoadLoop(options);
  const auto& [rig, controller, delay] = of;
  KeepController(options.svg_path, controller.path);
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
  bool blocks_stable = true;
  if (!controller.file.synchronous.blocks.empty()) {
    const auto blocks = JudgeBlocks(rig, controller.file);
    PrintBlocks(blocks, controller.file, json);
    blocks_stable = std::ranges::all_of(blocks, [](const auto& at) { return at.rig.stable(); });
  }
  const std::vector<LoopAtBias> at_bias = JudgeBias(rig, controller.file, loops);
  PrintBias(at_bias, rig.numbers.channels, json);
  fmt::print("{}{}", GainsNote(options, rig), RestNote(options, rig.numbers));
  Draw(options, of, loops, json);
  WriteJsonFile(options.json_path, json);
  std::vector<analysis::SensitivityResult> required_of = loops;
  for (const LoopAtBias& at : at_bias) required_of.push_back(at.loop);
  RequireLoops(required, required_of);
  if (!required.empty() && !blocks_stable) {
    throw Problem(ExitStatus::kNotMet,
                  fmt::format("--require {}: a block of synchronous control is "
                              "not stable at every speed of its window",
                              required));
  }
  return ExitStatus::kDone;
}

}  // namespace

void AddMarginsCommand(CLI::App& app, Action& action) {
  auto options = std::make_shared<MarginsOptions>();
  CLI::App* command = app.add_subcommand(
      "margins", "Sensitivity peaks with ISO 14839-3 zones, gain and phase margins, over speed");
  AddRigOption(*command, *options);
  AddControllerOption(*command, *options);
  AddPortOption(*command, *options);
  AddSpeedOption(*command, *options, {0.0});
  AddLoopRequirement(*command, options->required);
  AddSvgOption(*command, options->svg_path,
               "sensitivity with the zones of ISO 14839-3, and the Nyquist curve of every axis");
  AddJsonOption(*command, *options);
  command->callback([options, &action] { action = [options] { return Run(*options); }; });
}

}  // namespace levitas::cli

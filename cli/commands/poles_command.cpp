// amb poles: closed-loop poles of the sampled loop, the worst first.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "analysis/critical_speeds.hpp"
#include "analysis/poles.hpp"
#include "analysis/sampled_loop.hpp"
#include "analysis/synchronous_loop.hpp"
#include "cli/commands/angle_note.hpp"
#include "cli/commands/command.hpp"
#include "cli/commands/critical_speeds_text.hpp"
#include "cli/json_file.hpp"
#include "cli/options/analysis_options.hpp"
#include "cli/options/svg_option.hpp"
#include "common/rotational_speed.hpp"
#include "controller/synchronous/inverse_ladder.hpp"
#include "report/rig/campbell_panel.hpp"
#include "report/rig/poles_picture.hpp"
#include "session/log/output_path.hpp"

namespace levitas::cli {
namespace {

struct PolesOptions : AnalysisOptions {
  double up_to_hz{1000.0};
  std::string svg_path;
};

/// At rest neither direction is the forward one: both planes of the rig may share the pole, and any
/// mixture of them is a mode.
const char* WhirlOf(const analysis::Pole& pole, bool turning) {
  if (pole.frequency_hz == 0.0) return "no oscillation";
  if (!turning) return "at rest";
  if (std::abs(pole.forward_share - 0.5) < 0.05) return "plane";
  return pole.forward_share > 0.5 ? "forward" : "backward";
}

/// Five decimals; of a pole at the edge of stability three digits, so that its sign is one.
std::string DampingText(double ratio) {
  return std::abs(ratio) < 1e-3 ? fmt::format("{:.2e}", ratio) : fmt::format("{:.5f}", ratio);
}

/// Of every frequency: --up-to-hz hides none of the least damped.
constexpr std::size_t kAlwaysListed = 5;

void PrintHidden(std::size_t hidden, double least_damping, double up_to_hz) {
  if (hidden == 0) return;
  fmt::print("beyond {:g} Hz {} more, all damped better than the worst {} above: {} at least\n",
             up_to_hz, hidden, kAlwaysListed, DampingText(least_damping));
}

void Print(const analysis::LoopPoles& at, double up_to_hz) {
  fmt::print("{:.0f} rpm: {} (largest |z| {:.6f})\n", RadPerSToRpm(at.speed_rad_per_s),
             at.stable ? "STABLE" : "UNSTABLE", at.largest_pole_modulus);
  fmt::print("{:>14}{:>14}{:>14}  {}\n", "frequency Hz", "damping", "Re s 1/s", "whirl");
  std::size_t decaying = 0;
  std::size_t hidden = 0;
  double hidden_damping = 1.0;
  for (const auto& pole : analysis::WorstFirst(at.poles)) {
    const bool grows = analysis::Grows(pole);
    if (!grows) ++decaying;
    if (!grows && decaying > kAlwaysListed && std::abs(pole.frequency_hz) > up_to_hz) {
      ++hidden;
      hidden_damping = std::min(hidden_damping, pole.damping_ratio);
      continue;
    }
    fmt::print("{:>14.3f}{:>14}{:>14.3f}  {}{}\n", pole.frequency_hz,
               DampingText(pole.damping_ratio), pole.s_rad_per_s.real(),
               WhirlOf(pole, at.speed_rad_per_s != 0.0), grows ? "  <- unstable" : "");
  }
  PrintHidden(hidden, hidden_damping, up_to_hz);
}

nlohmann::ordered_json Json(const analysis::LoopPoles& at) {
  nlohmann::ordered_json json;
  json["speed_rpm"] = RadPerSToRpm(at.speed_rad_per_s);
  json["stable"] = at.stable;
  json["largest_pole_modulus"] = at.largest_pole_modulus;
  for (const auto& pole : analysis::WorstFirst(at.poles)) {
    json["poles"].push_back({{"frequency_hz", pole.frequency_hz},
                             {"damping_ratio", pole.damping_ratio},
                             {"real_part_1_per_s", pole.s_rad_per_s.real()},
                             {"imaginary_part_rad_per_s", pole.s_rad_per_s.imag()},
                             {"forward_share", pole.forward_share},
                             {"unstable", analysis::Grows(pole)}});
  }
  return json;
}

/// The same loop with the blocks of synchronous control that act at this speed; nothing without.
void AddBlocks(const analysis::SampledLoop& loop, const configuration::ControllerFile& controller,
               double speed_rad_per_s, nlohmann::ordered_json& json) {
  std::string acting;
  for (const auto& block : controller.synchronous.blocks) {
    if (!synchronous::ActsAt(block, speed_rad_per_s)) continue;
    acting += (acting.empty() ? "" : ", ") + block.name;
  }
  if (acting.empty()) return;
  const auto judged = analysis::JudgeSynchronous(loop, controller.synchronous, speed_rad_per_s);
  fmt::print("with synchronous control ({}): {} (largest |z| {:.6f}){}\n", acting,
             judged.stable() ? "STABLE" : "UNSTABLE", judged.largest_pole_modulus,
             AngleNote(controller.synchronous));
  json["with_synchronous_control"] = {{"blocks", acting},
                                      {"stable", judged.stable()},
                                      {"largest_pole_modulus", judged.largest_pole_modulus}};
}

ExitStatus Run(const PolesOptions& options) {
  session::CheckOutputPath(options.json_path, {});
  session::CheckOutputPath(options.svg_path, {});
  const auto [rig, controller, delay] = LoadLoop(options);
  KeepController(options.svg_path, controller.path);
  nlohmann::ordered_json json =
      LoopJson(rig.numbers, controller, rig.plant.delay_samples * rig.numbers.period_s());
  fmt::print("Poles of the sampled loop, delay included; rig {}, controller {}\n{}",
             rig.numbers.name, ControllerText(controller), delay);
  std::vector<analysis::LoopPoles> loops;
  for (const double rpm : options.speeds_rpm) {
    const double speed = RpmToRadPerS(rpm);
    const auto loop = analysis::CloseLoop(rig.plant, controller.file.law, speed);
    const auto& poles = loops.emplace_back(analysis::PolesOf(loop, speed));
    Print(poles, options.up_to_hz);
    nlohmann::ordered_json row = Json(poles);
    AddBlocks(loop, controller.file, speed, row);
    json["speeds"].push_back(std::move(row));
  }
  const double rated_rad_per_s = rig.numbers.max_speed_rad_per_s;
  const auto levitated = analysis::LevitatedCampbell(rig.plant, controller.file.law,
                                                     report::kBeyondRated * rated_rad_per_s);
  ShowCriticalSpeeds(levitated, "Critical speeds, levitated", json);
  svg::Write(options.svg_path,
             report::PolesPicture(
                 loops, levitated,
                 {fmt::format("Rig {}, controller {}", rig.numbers.name, controller.file.name),
                  options.up_to_hz, rated_rad_per_s}));
  WriteJsonFile(options.json_path, json);
  return ExitStatus::kDone;
}

}  // namespace

void AddPolesCommand(CLI::App& app, Action& action) {
  auto options = std::make_shared<PolesOptions>();
  CLI::App* command = app.add_subcommand(
      "poles", "Closed-loop poles of the sampled loop, delay included; the worst first");
  AddRigOption(*command, *options);
  AddControllerOption(*command, *options);
  AddPortOption(*command, *options);
  AddSpeedOption(*command, *options, {0.0});
  command
      ->add_option("--up-to-hz", options->up_to_hz,
                   "Print poles up to this frequency; those that grow and "
                   "the five least damped at any")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  AddSvgOption(*command, options->svg_path,
               "poles and their damping; levitated modes over speed with the critical speeds");
  AddJsonOption(*command, *options);
  command->callback([options, &action] { action = [options] { return Run(*options); }; });
}

}  // namespace levitas::cli

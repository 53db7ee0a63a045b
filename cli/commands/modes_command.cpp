// amb modes: mass, inertia, static loads, magnet constants, free whirl frequencies and critical
// speeds of a rig.

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "analysis/critical_speeds.hpp"
#include "analysis/damped_modes.hpp"
#include "analysis/free_modes.hpp"
#include "analysis/modal_effects.hpp"
#include "analysis/rotor_figures.hpp"
#include "cli/commands/command.hpp"
#include "cli/commands/critical_speeds_text.hpp"
#include "cli/commands/mode_notes.hpp"
#include "cli/json_file.hpp"
#include "cli/options/analysis_options.hpp"
#include "cli/options/svg_option.hpp"
#include "common/rotational_speed.hpp"
#include "plant_sim/effect/catalogue.hpp"
#include "report/rig/campbell_panel.hpp"
#include "report/rig/modes_picture.hpp"
#include "session/log/output_path.hpp"

namespace levitas::cli {
namespace {

constexpr int kCampbellSteps = 12;

struct ModesOptions : AnalysisOptions {
  bool campbell{};
  std::size_t modes{4};
  std::string svg_path;
};

std::vector<double> SpeedsOf(const ModesOptions& options, const configuration::RigFile& rig) {
  std::vector<double> speeds;
  if (options.campbell) {
    for (int i = 0; i <= kCampbellSteps; ++i) {
      speeds.push_back(rig.numbers.max_speed_rad_per_s * i / kCampbellSteps);
    }
    return speeds;
  }
  for (const double rpm : options.speeds_rpm) speeds.push_back(RpmToRadPerS(rpm));
  return speeds;
}

constexpr const char* kOfFree = "1x meets a free bending mode, magnets off";

analysis::Campbell CampbellOf(const ModesOptions& options, const configuration::RigFile& rig) {
  return analysis::FreeCampbell(rig.plant, report::kBeyondRated * rig.numbers.max_speed_rad_per_s,
                                options.modes);
}

void Print(const configuration::RigFile& rig, const analysis::FreeModes& modes,
           const analysis::RotorFigures& figures) {
  fmt::print("Rig {}: rotor mass {:.3f} kg, centre of mass at z = {:.1f} mm\n", rig.numbers.name,
             modes.rotor_mass_kg, 1e3 * figures.centre_z_m);
  fmt::print("  inertia about it {:.5g} kg m2 transverse, {:.5g} kg m2 polar\n",
             figures.transverse_inertia_kg_m2, figures.polar_inertia_kg_m2);
  for (std::size_t i = 0; i < modes.bearings.size(); ++i) {
    const auto& bearing = modes.bearings[i];
    const auto& load = figures.loads[i].load_n;
    fmt::print("  bearing {:<6} ki {:8.3f} N/A   ks {:.4e} N/m (destabilising)   static load {}\n",
               bearing.name, bearing.ki_n_per_a, bearing.ks_n_per_m,
               load ? fmt::format("{:.3f} N", *load) : "as the control shares it");
  }
  fmt::print("Free-free bending, Hz (b backward whirl, f forward whirl)\n{:>10}", "rpm");
  const std::size_t count = modes.whirl.empty() ? 0 : modes.whirl.front().forward_hz.size();
  for (std::size_t i = 1; i <= count; ++i) {
    fmt::print("{:>11}{:>11}", fmt::format("mode {} b", i), "f");
  }
  fmt::print("\n");
  for (const auto& at : modes.whirl) {
    fmt::print("{:>10.0f}", RadPerSToRpm(at.speed_rad_per_s));
    for (std::size_t i = 0; i < at.forward_hz.size(); ++i) {
      fmt::print("{:>11.3f}{:>11.3f}", at.backward_hz[i], at.forward_hz[i]);
    }
    fmt::print("\n");
  }
}

nlohmann::ordered_json Json(const configuration::RigFile& rig, const analysis::FreeModes& modes,
                            const analysis::RotorFigures& figures) {
  nlohmann::ordered_json json;
  json["rig"] = rig.numbers.name;
  json["rotor_mass_kg"] = modes.rotor_mass_kg;
  json["centre_of_mass_z_m"] = figures.centre_z_m;
  json["transverse_inertia_kg_m2"] = figures.transverse_inertia_kg_m2;
  json["polar_inertia_kg_m2"] = figures.polar_inertia_kg_m2;
  for (std::size_t i = 0; i < modes.bearings.size(); ++i) {
    const auto& bearing = modes.bearings[i];
    const auto& load = figures.loads[i].load_n;
    json["bearings"].push_back(
        {{"name", bearing.name},
         {"ki_n_per_a", bearing.ki_n_per_a},
         {"ks_n_per_m", bearing.ks_n_per_m},
         {"static_load_n", load ? nlohmann::ordered_json(*load) : nlohmann::ordered_json()}});
  }
  json["shapes"] = nlohmann::ordered_json::array();
  for (const auto& shape : figures.shapes) {
    json["shapes"].push_back({{"frequency_hz", shape.frequency_hz},
                              {"z_m", shape.z_m},
                              {"relative_deflection", shape.deflection}});
  }
  for (const auto& at : modes.whirl) {
    json["speeds"].push_back({{"speed_rpm", RadPerSToRpm(at.speed_rad_per_s)},
                              {"backward_hz", at.backward_hz},
                              {"forward_hz", at.forward_hz}});
  }
  return json;
}

void PrintDamped(const analysis::DampedModesAtSpeed& at, std::size_t count, const char* of) {
  fmt::print("{:.0f} rpm{}\n{:>14}{:>14}{:>14}  {}\n", RadPerSToRpm(at.speed_rad_per_s), of,
             "frequency Hz", "rad/s", "damping", "motion");
  const bool turning = at.speed_rad_per_s != 0.0;
  for (std::size_t i = 0; i < std::min(count, at.modes.size()); ++i) {
    const analysis::DampedMode& mode = at.modes[i];
    const char* whirl = mode.forward_share > 0.5 ? "forward" : "backward";
    if (!turning || std::abs(mode.forward_share - 0.5) < 0.05) whirl = "bending";
    fmt::print("{:>14.3f}{:>14.3f}{:>14.5f}  {}\n", mode.frequency_hz,
               RpmToRadPerS(60.0 * mode.frequency_hz), mode.damping_ratio,
               mode.torsion_share > 0.5 ? "torsion" : whirl);
  }
}

nlohmann::ordered_json DampedJson(const analysis::DampedModesAtSpeed& at) {
  nlohmann::ordered_json json{{"speed_rpm", RadPerSToRpm(at.speed_rad_per_s)}};
  for (const auto& mode : at.modes) {
    json["modes"].push_back({{"frequency_hz", mode.frequency_hz},
                             {"damping_ratio", mode.damping_ratio},
                             {"torsion_share", mode.torsion_share},
                             {"forward_share", mode.forward_share}});
  }
  return json;
}

/// Names of the file's effects of one influence, each once.
std::string Names(const configuration::RigFile& rig, effect::Modes influence) {
  std::vector<std::string> names;
  for (const effect::EffectConfig& entry : rig.plant.effects) {
    const std::string name(effect::At(entry.id).name);
    if (effect::At(entry.id).facts.modes != influence) continue;
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

/// Influence of the rig file's effects on the free rotor, and those that are not applied.
void ShowEffects(const ModesOptions& options, const configuration::RigFile& rig,
                 nlohmann::ordered_json& json) {
  using effect::Modes;
  if (rig.plant.effects.empty()) return;
  fmt::print("\nThe numbers above are those of the rotor without the effects of the rig file.\n");
  if (const auto names = Names(rig, Modes::kOnTheRotor); !names.empty()) {
    fmt::print("With {} at full strength; damped modes, magnets without current:\n", names);
    for (const double speed : SpeedsOf(options, rig)) {
      const auto at = analysis::DampedModes(analysis::WithModalEffects(rig.plant), speed);
      PrintDamped(at, 2 * options.modes, "");  // both planes have their modes
      json["with_effects"].push_back(DampedJson(at));
    }
  }
  constexpr std::array kOthers{
      std::pair{Modes::kTurning,
                "turn with the rotor: no frequency stays the same over a turn. amb run shows them"},
      std::pair{
          Modes::kOnTheLoop,
          "change the levitated rotor, not the free one: amb poles has what is linear of them"},
      std::pair{Modes::kNone, "change no mode"}};
  for (const auto& [influence, why] : kOthers) {
    const std::string names = Names(rig, influence);
    if (!names.empty()) fmt::print("Not applied: {} ({})\n", names, why);
  }
}

/// Of all modes that the rig has when it is run, also those beyond the ones asked for.
void PrintNotes(const configuration::RigFile& rig) {
  const auto at_rest = analysis::DampedModes(rig.plant, 0.0);
  for (const std::string& note : ModeNotes(at_rest.modes, 1.0 / rig.numbers.period_s())) {
    fmt::print("{}\n", note);
  }
}

/// Shafts on supports of their own are not free: their damped modes, magnets without current.
ExitStatus ShowDamped(const ModesOptions& options, const configuration::RigFile& rig) {
  fmt::print("Rig {}: {} shafts, {} gears; damped modes, magnets without current\n",
             rig.numbers.name, rig.plant.shafts.size(), rig.plant.gears.size());
  nlohmann::ordered_json json{{"rig", rig.numbers.name}};
  for (const double speed : SpeedsOf(options, rig)) {
    const auto at = analysis::DampedModes(rig.plant, speed);
    // Both planes have their modes, and torsion its own.
    PrintDamped(at, 3 * options.modes, " of the first shaft");
    json["speeds"].push_back(DampedJson(at));
  }
  PrintNotes(rig);
  const auto campbell = CampbellOf(options, rig);
  ShowCriticalSpeeds(campbell, "Rotation meets a mode, magnets without current", json);
  svg::Write(options.svg_path, report::ModesPicture(rig, campbell, std::nullopt));
  WriteJsonFile(options.json_path, json);
  return ExitStatus::kDone;
}

ExitStatus Run(const ModesOptions& options) {
  session::CheckOutputPath(options.json_path, {});
  session::CheckOutputPath(options.svg_path, {});
  const configuration::RigFile rig = LoadRig(options);
  if (!rig.plant.shafts.empty()) return ShowDamped(options, rig);
  const auto modes = analysis::ComputeFreeModes(rig.plant, SpeedsOf(options, rig), options.modes);
  const auto figures = analysis::FiguresOf(rig.plant, options.modes);
  Print(rig, modes, figures);
  PrintNotes(rig);
  nlohmann::ordered_json json = Json(rig, modes, figures);
  const auto campbell = CampbellOf(options, rig);
  ShowCriticalSpeeds(campbell, kOfFree, json);
  ShowEffects(options, rig, json);
  svg::Write(options.svg_path, report::ModesPicture(rig, campbell, figures));
  WriteJsonFile(options.json_path, json);
  return ExitStatus::kDone;
}

}  // namespace

void AddModesCommand(CLI::App& app, Action& action) {
  auto options = std::make_shared<ModesOptions>();
  CLI::App* command = app.add_subcommand(
      "modes", "Free modes of a rig over speed, rotor mass, ki and ks of every magnet");
  AddRigOption(*command, *options);
  AddSpeedOption(*command, *options, {0.0});
  command->add_flag("--campbell", options->campbell, "From standstill to the rated speed");
  command->add_option("--modes", options->modes, "How many flexible modes")
      ->check(CLI::Range(1, 20))
      ->capture_default_str();
  AddSvgOption(*command, options->svg_path,
               "Campbell diagram with its 1x crossings; mode shapes on the shaft, static loads");
  AddJsonOption(*command, *options);
  command->callback([options, &action] { action = [options] { return Run(*options); }; });
}

}  // namespace levitas::cli

#include "cli/options/analysis_options.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <map>

#include "cli/run/general_files.hpp"
#include "common/rotational_speed.hpp"
#include "configuration/law_notes.hpp"
#include "configuration/run_files.hpp"
#include "controller/law/discrete_law.hpp"
#include "hil/socketcan/can_connection.hpp"
#include "session/log/output_path.hpp"

namespace levitas::cli {
namespace {

constexpr const char* kReferenceController = "flexible_rotor";
constexpr double kFastestRpm = 1e6;  // beyond any rotor: turbine-driven spindles reach 5e5

constexpr double kWorthSaying = 0.01;  // of the frequency that the file gives for a notch

/// Notches that stand elsewhere in discrete time, each once with the axes that have it.
std::string NotchesElsewhere(const configuration::ControllerFile& controller,
                             const RigNumbers& rig) {
  std::map<double, std::vector<std::string>> axes;  // by the frequency given
  const law::LawConfig& law = controller.law;       // of a schedule, that at rest
  const std::size_t count = std::min(law.axes.size(), rig.channels.size());
  for (std::size_t i = 0; i < count; ++i) {
    for (const law::Notch& notch : law.axes[i].notches) {
      const double away = std::abs(law::StandsAt(notch, rig.period_s()) - notch.frequency_hz);
      if (away <= kWorthSaying * notch.frequency_hz) continue;
      auto& names = axes[notch.frequency_hz];
      if (names.empty() || names.back() != rig.channels[i]) names.push_back(rig.channels[i]);
    }
  }
  std::string text;
  for (const auto& [frequency_hz, names] : axes) {
    const double stands_hz = law::StandsAt({frequency_hz, 0.0, 1.0}, rig.period_s());
    text += fmt::format("\n  the notch given at {:.1f} Hz stands at {:.1f} Hz ({})", frequency_hz,
                        stands_hz, fmt::join(names, ", "));
  }
  if (!text.empty()) text += "\n  (Tustin's rule; prewarp: true puts a notch where it is given)";
  if (!text.empty() && !law.schedule.empty()) text += "\n  (notches of the law at rest)";
  return text;
}

/// The reason why one real wire in place of the buses of the file would not carry the loop.
std::string OneWireNote(const AnalysisOptions& options, const configuration::RigFile& rig) {
  const std::string refusal =
      socketcan::RealWireRefusal(rig.numbers, rig.buses, options.rig_name, options.port);
  if (refusal.empty()) return {};
  return fmt::format("  on real wires {} would not carry the loop: {}\n", options.port, refusal);
}

/// Refuses what strtod accepts and no rotor does.
std::string CheckSpeed(const std::string& text) {
  double rpm = 0.0;
  if (!CLI::detail::lexical_cast(text, rpm) || !(std::abs(rpm) <= kFastestRpm)) {
    return "found '" + text + "', allowed: -1e6 to 1e6 revolutions per minute";
  }
  return {};
}

}  // namespace

void AddRigOption(CLI::App& command, AnalysisOptions& options) {
  command.add_option("--rig", options.rig_name, "Rig file, or the name of a shipped rig")
      ->capture_default_str();
}

void AddPortOption(CLI::App& command, AnalysisOptions& options) {
  command
      .add_option("--port", options.port,
                  "Whose delay counts: lcm (the rig file's), can or can:IF,... (of its buses)")
      ->check([](const std::string& port) {
        if (port == "lcm" || socketcan::IsCanPort(port)) return std::string{};
        return "found '" + port + "', allowed: lcm, can, can:IF,...";
      })
      ->capture_default_str();
}

std::string TakeDelayOfPort(const AnalysisOptions& options, configuration::RigFile& rig) {
  const double of_file = rig.plant.delay_samples;
  if (options.port == "lcm") {
    return fmt::format("delay from sample to current: {:.2f} periods, of the rig file{}\n", of_file,
                       rig.buses.empty() ? "" : " (on its CAN buses: --port can)");
  }
  // Nothing is connected here, so no interface has to exist: each bus of the file counts.
  const auto every = [](const std::string&) { return true; };
  const auto connection =
      socketcan::PlanConnection(rig.numbers, rig.buses, options.rig_name, options.port, every);
  rig.plant.delay_samples = socketcan::DelayOnBuses(of_file, rig.numbers, connection.budget);
  return fmt::format(
      "delay from sample to current: {:.2f} periods, the longer one of {} and the rig file "
      "({:.2f})\n{}",
      rig.plant.delay_samples, options.port, of_file, OneWireNote(options, rig));
}

void AddControllerOption(CLI::App& command, AnalysisOptions& options) {
  command
      .add_option("--controller", options.controller_name,
                  "Controller file or shipped name; default: the one the rig file names")
      ->default_str(kReferenceController);
}

void AddSpeedOption(CLI::App& command, AnalysisOptions& options, std::vector<double> default_rpm) {
  options.speeds_rpm = std::move(default_rpm);
  command
      .add_option("--speed-rpm,--speeds", options.speeds_rpm,
                  "Rotor speed in rpm, or several separated by commas")
      ->delimiter(',')
      ->check(CLI::Validator(CheckSpeed, "RPM"))
      ->capture_default_str();
}

void AddJsonOption(CLI::App& command, AnalysisOptions& options) {
  command.add_option("--json", options.json_path,
                     "Also write the result to this file; -: to standard output, the text then to "
                     "standard error");
}

configuration::RigFile LoadRig(const AnalysisOptions& options) {
  return configuration::LoadRig(configuration::FindConfig(options.rig_name, "rigs"));
}

FoundController LoadController(const AnalysisOptions& options, const configuration::RigFile& rig) {
  const std::string path =
      configuration::FindController(rig.run, options.controller_name, kReferenceController);
  session::RefuseClash({{"--json", options.json_path}}, {{"the controller file", path}});
  FoundController found{path, configuration::LoadFound(path, rig, options.controller_name), {}};
  found.notes = NotchesElsewhere(found.file, rig.numbers);
  for (const std::string& note : configuration::LawNotes(found.file.law))
    found.notes += "\n  " + note;
  return found;
}

AnalysedLoop LoadLoop(const AnalysisOptions& options) {
  AnalysedLoop loop;
  loop.rig = LoadRig(options);
  loop.controller = LoadController(options, loop.rig);
  loop.delay = TakeDelayOfPort(options, loop.rig);
  return loop;
}

std::string ControllerText(const FoundController& controller) {
  return fmt::format("{} ({}){}", controller.file.name, controller.path, controller.notes);
}

std::string GainsNote(const AnalysisOptions& options, const configuration::RigFile& rig) {
  if (!options.controller_name.empty() || !rig.run.controller.empty()) return {};
  return fmt::format("These are the reference gains. amb run takes others: --controller {}\n",
                     kGeneralController);
}

std::string RestNote(const AnalysisOptions& options, const RigNumbers& rig) {
  const bool rest = options.speeds_rpm.size() == 1 && options.speeds_rpm.front() == 0.0;
  if (!rest || !(rig.max_speed_rad_per_s > 0.0)) return {};
  return fmt::format("At rest only; the rated speed too: --speeds 0,{:.6g}\n",
                     RadPerSToRpm(rig.max_speed_rad_per_s));
}

}  // namespace levitas::cli

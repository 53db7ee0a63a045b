#include "programs/plant/plant_options.hpp"

#include <CLI/CLI.hpp>
#include <string>

#include "common/time_option.hpp"
#include "common/whole_number.hpp"

namespace levitas::plant_run {

const char* PaceName(const PlantOptions& options) noexcept {
  if (options.realtime) return "realtime";
  return options.pace_factor > 0.0 ? "paced" : "lockstep";
}

namespace {

void AddPace(CLI::App& app, PlantOptions& options) {
  app.add_option("--pace")
      ->description("lockstep (default), realtime, or paced: lockstep held to the clock")
      ->default_str("lockstep")
      ->check(CLI::IsMember({"lockstep", "realtime", "paced"}))
      ->type_name("PACE");
  app.add_option("--pace-factor", options.pace_factor,
                 "With --pace paced: how many seconds of the rig pass in one of the clock")
      ->check(CLI::Range(kLeastPaceFactor, kMostPaceFactor))
      ->capture_default_str();
}

/// What --pace and --pace-factor say together.
void SettlePace(const CLI::App& app, PlantOptions& options) {
  const auto pace = app.get_option("--pace")->as<std::string>();
  options.realtime = pace == "realtime";
  if (pace == "paced") return;
  if (app.count("--pace-factor") > 0) {
    throw CLI::ValidationError("--pace-factor", "is for --pace paced");
  }
  options.pace_factor = 0.0;
}

}  // namespace

void AddOptions(CLI::App& app, const PlantProgram& program, PlantOptions& options) {
  options.port = program.default_port;
  options.watchdog_periods = program.watchdog_periods;
  options.pace_factor = 1.0;
  app.add_option("--rig", options.rig, "Rig file, or the name of a shipped one")->required();
  app.add_option(
      "--scenario", options.scenario,
      "Scenario whose rig_events happen to the rig; a file, or the name of a shipped one");
  app.add_option("--port", options.port, program.port_help)->capture_default_str();
  app.add_option("--key", options.key,
                 "amb-plant: file with the key of those who may speak on the network; with ttl "
                 "above 0 it is needed");
  AddPace(app, options);
  app.add_option("--seed", options.seed, "Seed of the sensor noise")
      ->check(WhyNoWholeNumber)
      ->capture_default_str();
  app.add_option("--json", options.json, "Write statistics to this file");
  app.add_option("--partner-timeout", options.partner_timeout_s,
                 "Give up after this long without a controller [s]")
      ->check(WhyNoTime)
      ->capture_default_str();
  app.add_flag("--require-realtime", options.require_realtime,
               "Refuse to run when the machine does not grant real-time conditions");
  app.add_option("--watchdog", options.watchdog_periods,
                 "Switch the amplifiers off after this many periods without a valid current")
      ->check(CLI::Range(1U, 1'000'000U))
      ->capture_default_str();
  app.add_flag("--no-lines", options.no_lines,
               "amb-rig: leave the rig file's lines (enable, heartbeat ...) alone");
  app.add_flag(
      "--on-a-real-bus", options.on_a_real_bus,
      "amb-rig: play the rig also on a bus that is no virtual one; no real rig may be on it");
  app.add_flag("--stay", options.stay, "When the controller ends, wait for the next one");
  app.footer(program.examples);
}

bool ReadCommandLine(int argc, char** argv, const PlantProgram& program, PlantOptions& options,
                     ExitStatus& status) {
  CLI::App app{program.description, program.name};
  AddOptions(app, program, options);
  try {
    app.parse(argc, argv);
    SettlePace(app, options);
    return true;
  } catch (const CLI::ParseError& error) {
    status = app.exit(error) == 0 ? ExitStatus::kDone : ExitStatus::kUsage;
    return false;
  }
}

}  // namespace levitas::plant_run

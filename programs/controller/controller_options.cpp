#include "programs/controller/controller_options.hpp"

#include <CLI/CLI.hpp>
#include <map>

#include "common/time_option.hpp"
#include "common/whole_number.hpp"
#include "session/log/output_path.hpp"

namespace levitas::controller_program {

namespace {

void AddNetworkOptions(CLI::App& app, ControllerOptions& options) {
  app.add_option("--port", options.port,
                 "lcm, lcm:udpm://<group>:<port>?ttl=<n>, can (buses of the rig's file), or "
                 "can:IF[,IF...]")
      ->capture_default_str();
  app.add_option("--telemetry", options.telemetry,
                 "With --port can: LCM network for state, events and commands (default lcm)");
  app.add_option("--key", options.key,
                 "File with the key of those who may speak on the network (amb key FILE makes "
                 "one); with ttl above 0 it is needed");
  using transport::CommandWish;
  auto* none = app.add_flag_callback(
      "--no-commands", [&options] { options.commands = CommandWish::kNo; },
      "Take no commands over the network");
  app.add_flag_callback(
         "--commands", [&options] { options.commands = CommandWish::kYes; },
         "Take commands over the network also with a rig on a real bus and without a key")
      ->excludes(none);
}

void AddRecordingOptions(CLI::App& app, ControllerOptions& options) {
  app.add_option("--record", options.record,
                 "Session file to write; packed by zstd under a name that ends in .zst");
  app.add_flag("--overwrite", options.overwrite, "Replace a session that is there already");
  app.add_option("--trip-folder", options.trip_folder, "Where a trip's recording goes")
      ->capture_default_str();
  app.add_option("--trip-budget", options.trip_budget,
                 "FILES MB: so many trip files of this run, and so much, stay in that folder; its "
                 "older ones go, those of earlier runs stay")
      ->expected(2)
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
}

}  // namespace

void AddOptions(CLI::App& app, ControllerOptions& options) {
  // In a paced run it is the simulated rig that waits for the clock.
  const std::map<std::string, bool> paces{
      {"lockstep", false}, {"paced", false}, {"realtime", true}};
  app.add_option("--rig", options.rig, "Rig file, or the name of a shipped one")->required();
  app.add_option("--controller", options.controller, "Controller file, or a shipped name")
      ->required();
  app.add_option("--scenario", options.scenario,
                 "Scenario to play; without it commands come over the network");
  AddNetworkOptions(app, options);
  app.add_option("--pace", options.realtime,
                 "lockstep (default), realtime, or paced: lockstep that the rig holds to the clock")
      ->transform(CLI::Transformer(paces))
      ->type_name("PACE");
  app.add_option("--duration", options.duration_s, "Land and end after this long [s]")
      ->check(WhyNoTime);
  AddRecordingOptions(app, options);
  app.add_option("--seed", options.seed, "Seed of the rig, noted in the session")
      ->check(WhyNoWholeNumber)
      ->capture_default_str();
  app.add_option("--json", options.json, "Write statistics to this file");
  app.add_option("--partner-timeout", options.partner_timeout_s,
                 "Give up after this long without sensor frames [s]")
      ->check(WhyNoTime)
      ->capture_default_str();
  app.add_flag("--require-realtime", options.require_realtime,
               "Refuse to run when the machine does not grant real-time conditions");
  app.add_option("--processor", options.processor, "Run the loop on this processor only")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--life-line", options.life_line,
                 "Descriptor of a pipe: land when its other end is closed (amb run's own)")
      ->check(CLI::NonNegativeNumber);
  app.add_flag("--no-lines", options.no_lines,
               "Leave the rig file's lines (emergency stop, enable ...) alone");
  app.footer(
      "  amb-controller --rig flexible_rotor --controller flexible_rotor --pace realtime \\\n"
      "      --record run.lcm.zst\n"
      "  amb-controller --rig rig.yaml --controller law.yaml --port can --pace realtime \\\n"
      "      --require-realtime");
}

bool ReadCommandLine(int argc, char** argv, ControllerOptions& options, ExitStatus& status) {
  CLI::App app{kDescription, kName};
  AddOptions(app, options);
  try {
    app.parse(argc, argv);
    session::RefuseClash({{"--record", options.record}, {"--json", options.json}},
                         {{"--rig", options.rig},
                          {"--controller", options.controller},
                          {"--scenario", options.scenario},
                          {"--key", options.key}});
    session::CheckNoRecording(options.record, options.overwrite);
    return true;
  } catch (const CLI::ParseError& error) {
    status = app.exit(error) == 0 ? ExitStatus::kDone : ExitStatus::kUsage;
    return false;
  }
}

}  // namespace levitas::controller_program

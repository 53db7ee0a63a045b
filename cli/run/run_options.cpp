#include "cli/run/run_options.hpp"

#include <fmt/core.h>

#include <filesystem>
#include <utility>

#include "common/problem.hpp"
#include "configuration/rig_file.hpp"
#include "configuration/run_files.hpp"
#include "hil/socketcan/can_connection.hpp"

namespace levitas::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kReferenceRig = "flexible_rotor";

/// Runs `read`, which may find a file unusable, and adds what it says to `problems`.
template <class Read>
bool Collect(std::string& problems, Read read) {
  try {
    read();
    return true;
  } catch (const BadInput& problem) {
    if (!problems.empty()) problems += "\n";
    problems += problem.what();
    return false;
  }
}

/// A factor is meant for a paced run, whatever else would be usual.
std::string UsualPace(const RunOptions& options) {
  if (options.rig_is_there) return "realtime";
  return options.page == PageWish::kAlways || options.pace_factor ? "paced" : "lockstep";
}

void RefuseWrongPace(const RunOptions& options) {
  if (options.pace_factor && options.pace != "paced") {
    throw Problem(
        ExitStatus::kUsage,
        fmt::format("--pace-factor is for --pace paced, and the pace is {}", options.pace));
  }
  if (options.pace == "paced" && options.rig_is_there) {
    throw Problem(
        ExitStatus::kUsage,
        "--pace paced holds a simulated rig to the clock, and none is started here: a real "
        "rig keeps --pace realtime, one that is simulated elsewhere is started with --pace "
        "paced there and --pace lockstep here");
  }
}

}  // namespace

RunFiles CheckFiles(const RunOptions& options) {
  RunFiles files;
  std::string problems;
  configuration::RigFile rig;
  const bool rig_good = Collect(problems, [&] {
    files.rig_path = configuration::FindConfig(options.rig, "rigs");
    RigAsRun as_run = ReadRigAsRun(files.rig_path, options.changes);
    rig = std::move(as_run.rig);
    files.rig = rig.numbers;
    files.rig_text = std::move(as_run.text);
  });
  // The other two are read for a rig. Without one, the shipped rig shows at least what is wrong in
  // them whatever the rig.
  if (!rig_good) {
    rig.numbers = configuration::LoadRig(configuration::FindConfig(kReferenceRig, "rigs")).numbers;
    problems +=
        fmt::format("\n(the other files are checked against the shipped rig {})", kReferenceRig);
  }
  Collect(problems, [&] {
    files.controller_path =
        configuration::FindController(rig.run, options.controller, kGeneralController);
    static_cast<void>(configuration::LoadFound(files.controller_path, rig, options.controller));
  });
  Collect(problems, [&] {
    files.scenario_path = configuration::FindScenario(rig.run, options.scenario, kGeneralScenario);
    files.scenario_name = configuration::LoadScenario(files.scenario_path, rig.numbers).name;
  });
  if (!problems.empty()) throw BadInput(problems);
  return files;
}

std::optional<transport::LcmNetwork> CheckPort(const std::string& port) {
  if (port.empty() || socketcan::IsCanPort(port)) return std::nullopt;
  return transport::ParseLcmNetwork(port, "can, can:IF[,IF...], ");
}

RunOptions SettleRig(RunOptions options, const configuration::RigFile& rig,
                     socketcan::LinkKind (*find)(const std::string&)) {
  if (options.rig_is_there && options.port.empty()) {
    throw Problem(ExitStatus::kUsage,
                  "--no-simulated-rig needs --port: where the rig is that is there already");
  }
  if (socketcan::IsCanPort(options.port)) {
    const bool waits = options.pace == "lockstep" || options.pace == "paced";
    if (waits) socketcan::RefuseLockstep(rig.buses, options.port, find);
    options.rig_is_there =
        options.rig_is_there || !socketcan::RealInterface(rig.buses, options.port, find).empty();
  }
  if (options.rig_is_there && !options.changes.effects.empty()) {
    throw Problem(ExitStatus::kUsage,
                  "--effect changes the simulated rig, and none is simulated here");
  }
  if (options.pace.empty()) options.pace = UsualPace(options);
  RefuseWrongPace(options);
  return options;
}

void CheckBuses(const RunOptions& options, const RunFiles& files) {
  if (!socketcan::IsCanPort(options.port)) return;
  const configuration::RigFile rig = configuration::LoadRig(files.rig_path);
  static_cast<void>(
      socketcan::PlanConnection(rig.numbers, rig.buses, files.rig_path, options.port));
}

std::string ProgramBeside(const std::string& name) {
  std::error_code none;
  const fs::path own = fs::read_symlink("/proc/self/exe", none);
  const fs::path program = own.parent_path() / name;
  if (fs::exists(program, none)) return program.string();
  throw Problem(ExitStatus::kOther,
                fmt::format("{} is not beside {}: build or install all programs into one folder",
                            name, own.string()));
}

RunPlan PlanRun(const RunOptions& options, const RunFiles& files, const RunPaths& paths,
                const transport::LcmNetwork& network) {
  const std::string lcm = "lcm:" + network.Url(transport::Direction::kSensor);
  const bool can = socketcan::IsCanPort(options.port);
  const std::vector<std::string> both{
      "--rig",  files.rig_path, "--port", can ? options.port : lcm,
      "--pace", options.pace,   "--seed", std::to_string(options.seed)};
  RunPlan plan;
  if (!options.rig_is_there) {
    plan.plant = {ProgramBeside(can ? "amb-rig" : "amb-plant"), both, paths.plant_log};
    plan.plant.arguments.insert(plan.plant.arguments.end(),
                                {"--scenario", files.scenario_path, "--json", paths.plant_json});
    if (options.pace_factor) {
      plan.plant.arguments.insert(plan.plant.arguments.end(),
                                  {"--pace-factor", fmt::format("{}", *options.pace_factor)});
    }
  }
  plan.controller = {ProgramBeside("amb-controller"), both, paths.controller_log, "--life-line"};
  plan.controller.arguments.insert(
      plan.controller.arguments.end(),
      {"--controller", files.controller_path, "--scenario", files.scenario_path, "--record",
       paths.session, "--trip-folder", paths.trip_folder, "--json", paths.controller_json});
  if (options.overwrite) plan.controller.arguments.emplace_back("--overwrite");
  if (can) plan.controller.arguments.insert(plan.controller.arguments.end(), {"--telemetry", lcm});
  if (!options.key.empty()) {
    // Frames on a bus carry no seal; the controller's own network does.
    if (!can) plan.plant.arguments.insert(plan.plant.arguments.end(), {"--key", options.key});
    plan.controller.arguments.insert(plan.controller.arguments.end(), {"--key", options.key});
  }
  if (options.no_commands) plan.controller.arguments.emplace_back("--no-commands");
  if (options.duration_s > 0.0) {
    plan.controller.arguments.insert(plan.controller.arguments.end(),
                                     {"--duration", fmt::format("{}", options.duration_s)});
  }
  return plan;
}

}  // namespace levitas::cli

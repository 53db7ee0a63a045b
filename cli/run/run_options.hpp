#pragma once
// What `amb run` was asked for, checked, and the programs called to do it.
//
// Failure  Problem with the exit status of the contract: 2 for a port or pace that does not exist,
//          3 with every problem of all three files at once.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli/run/general_files.hpp"
#include "cli/run/live_page.hpp"
#include "cli/run/rig_as_run.hpp"
#include "cli/run/supervise.hpp"
#include "common/rig_numbers.hpp"
#include "configuration/rig_file.hpp"
#include "hil/socketcan/link_kind.hpp"
#include "transport/lcm_network.hpp"

namespace levitas::cli {

struct RunOptions {
  std::string rig{"flexible_rotor"};
  std::string controller;  ///< empty: the one that the rig names, else kGeneralController
  std::string scenario;    ///< empty: the one that the rig names, else kGeneralScenario
  RigChanges changes;      ///< of the rig file
  std::string rig_out;     ///< where the rig as run is written; empty: nowhere
  double duration_s{0.0};  ///< 0: as long as the scenario takes
  std::string pace;        ///< empty: see SettleRig
  std::optional<double> pace_factor;  ///< of a paced run; none: 1
  std::string port;                   ///< empty: lcm on ports nobody else uses
  bool rig_is_there{};            ///< start the controller alone: the rig is on the port already
  std::string key;                ///< file with the key of those who may speak; empty: none
  bool no_commands{};             ///< nobody commands over the network
  std::string record_path;        ///< empty: a temporary file
  bool overwrite{false};          ///< a record that is there already
  std::vector<std::string> tags;  ///< of the record in the catalogue of sessions
  std::int64_t seed{1};
  std::string json_path;
  std::string required;  ///< cli/options/requirement.hpp
  PageWish page{PageWish::kIfUseful};
};

/// The three files, found and read without a problem.
struct RunFiles {
  std::string rig_path, controller_path, scenario_path;
  std::string scenario_name;
  RigNumbers rig;        ///< as run
  std::string rig_text;  ///< of the rig as run, see rig_as_run.hpp
};

/// Reads all three; throws one BadInput with the problems of all of them.
[[nodiscard]] RunFiles CheckFiles(const RunOptions& options);

/// The network --port names; empty when free ports are to be looked for (with a CAN port for
/// telemetry). Refuses what is neither an LCM nor a CAN port with the list of what is.
[[nodiscard]] std::optional<transport::LcmNetwork> CheckPort(const std::string& port);

/// Completes what depends on what is on the port. On a bus that is no virtual one only a real rig
/// can be: then none is simulated, and the pace is real time. A simulated rig runs in lockstep, and
/// held to the clock where the live page is asked for: real time itself is for machines that hold
/// it. Refuses what contradicts that, and a rig that is said to be there without a port where it
/// could be.
[[nodiscard]] RunOptions SettleRig(
    RunOptions options, const configuration::RigFile& rig,
    socketcan::LinkKind (*find)(const std::string&) = socketcan::FindLink);

/// Refuses a CAN port whose buses do not carry the loop of the rig; nothing happens for LCM.
void CheckBuses(const RunOptions& options, const RunFiles& files);

/// Path of a program that is installed beside this one.
[[nodiscard]] std::string ProgramBeside(const std::string& name);

/// Where one run keeps what it writes.
struct RunPaths {
  std::string session, controller_json, plant_json, controller_log, plant_log, trip_folder;
};

[[nodiscard]] RunPlan PlanRun(const RunOptions& options, const RunFiles& files,
                              const RunPaths& paths, const transport::LcmNetwork& network);

}  // namespace levitas::cli

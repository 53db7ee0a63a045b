#pragma once
// Strict reading and complete writing of the three kinds of file. Every problem of a file is found
// and listed at once: file, line, column, key, found, allowed, nearest key. Nothing is clamped.
//
// Failure  BadInput whose text is the whole list (exit status 3).
// Thread   any; not for the control cycle.

#include <optional>
#include <string>
#include <vector>

#include "common/rig_numbers.hpp"
#include "configuration/tolerances.hpp"
#include "controller/bias/bias_config.hpp"
#include "controller/law/law_config.hpp"
#include "controller/scenario/scenario_config.hpp"
#include "controller/supervisor/supervisor_config.hpp"
#include "controller/synchronous/synchronous_config.hpp"
#include "hil/can/bus_config.hpp"
#include "hil/gpio/line_config.hpp"
#include "plant_sim/plant/plant_config.hpp"

namespace levitas::configuration {

/// What the commands use with this rig unless they are told otherwise; empty: the general choice.
struct RunDefaults {
  std::string controller;
  std::string scenario;
};

/// How the rig's own software logs: one matrix of a MAT file, a quantity a row.
struct LogLayout {
  std::string matrix;
  std::vector<std::string> rows;  ///< names as of the columns of a CSV file; empty: not known
};

struct RigFile {
  RigNumbers numbers;
  plant::PlantConfig plant;
  RunDefaults run;
  gpio::LinesConfig lines;            ///< empty when the file names none
  std::vector<can::BusConfig> buses;  ///< CAN; empty when the file names none
  LogLayout log;
  std::optional<Tolerances> tolerances;  ///< none: the file states none, Tolerances{} holds
};

struct ControllerFile {
  std::string name;
  law::LawConfig law;  ///< one entry per axis of the rig it was read for
  supervisor::SupervisorConfig supervisor;
  synchronous::SynchronousConfig synchronous{};  ///< empty: none
  bias::BiasConfig bias{};                       ///< empty: the bias stays at the rig's
};

[[nodiscard]] RigFile LoadRig(const std::string& path);
[[nodiscard]] RigFile ParseRig(const std::string& text, const std::string& file_name);
/// The rig is needed for the channel and bearing names the file refers to, period and limits.
[[nodiscard]] ControllerFile LoadController(const std::string& path, const RigNumbers& rig);
[[nodiscard]] ControllerFile ParseController(const std::string& text, const std::string& file_name,
                                             const RigNumbers& rig);
[[nodiscard]] scenario::ScenarioConfig LoadScenario(const std::string& path, const RigNumbers& rig);
[[nodiscard]] scenario::ScenarioConfig ParseScenario(const std::string& text,
                                                     const std::string& file_name,
                                                     const RigNumbers& rig);

/// Complete YAML text, every default written out; parsing it gives the same values bit for bit.
[[nodiscard]] std::string WriteRig(const RigFile& rig);
[[nodiscard]] std::string WriteController(const ControllerFile& controller, const RigNumbers& rig);
[[nodiscard]] std::string WriteScenario(const scenario::ScenarioConfig& scenario);

/// `name` is a path, or the name of a file shipped with the program ("flexible_rotor" finds
/// config/rigs/flexible_rotor.yaml). Kind is "rigs", "controllers" or "scenarios". The shipped
/// files are found in $LEVITAS_CONFIG, else beside the binary's build tree or installation.
[[nodiscard]] std::string FindConfig(const std::string& name, const std::string& kind);

}  // namespace levitas::configuration

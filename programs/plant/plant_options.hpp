#pragma once
// Command line of the programs that simulate a rig: amb-plant over LCM, amb-rig over CAN.

#include <cstdint>
#include <string>

#include "common/problem.hpp"

namespace CLI {  // NOLINT(readability-identifier-naming): the library is called so
class App;
}

namespace levitas::plant_run {

/// Bounds of --pace-factor: slower than the least, telemetry would count as silent.
inline constexpr double kLeastPaceFactor = 0.05;
inline constexpr double kMostPaceFactor = 100.0;

struct PlantOptions {
  std::string rig;          ///< path or shipped name
  std::string scenario;     ///< path or shipped name; empty: nothing happens to the rig
  std::string port{"lcm"};  ///< lcm or lcm:URL
  std::string key;          ///< file with the key of those who may speak; empty: none
  bool realtime{false};
  double pace_factor{0.0};  ///< above 0: lockstep, held to the clock times this
  std::uint64_t seed{1};
  std::string json;  ///< statistics go there; empty: nowhere
  double partner_timeout_s{30.0};
  bool require_realtime{false};
  bool stay{false};  ///< wait for the next controller instead of ending with the present one
  std::uint32_t watchdog_periods{1000};
  bool no_lines{false};       ///< amb-rig: leave the rig file's lines alone
  bool on_a_real_bus{false};  ///< amb-rig: play the rig also on a bus that is no virtual one
};

/// "lockstep", "paced" or "realtime".
[[nodiscard]] const char* PaceName(const PlantOptions& options) noexcept;

/// What differs between the programs.
struct PlantProgram {
  const char* name;
  const char* description;
  const char* port_help;
  const char* default_port;
  std::uint32_t watchdog_periods;
  const char* examples;
};

inline constexpr PlantProgram kAmbPlant{
    "amb-plant",
    "Simulated magnetic bearing rig: sends sensor frames, takes current frames",
    "lcm, or lcm:udpm://<group>:<port>?ttl=<n>",
    "lcm",
    1000,
    "  amb-plant --rig flexible_rotor --pace realtime --stay\n"
    "  amb-plant --rig rig.yaml --scenario scenario.yaml --json plant.json"};
inline constexpr PlantProgram kAmbRig{
    "amb-rig",
    "Simulated magnetic bearing rig behind CAN buses, with the watchdog of a real one",
    "can (interfaces of the rig's file), or can:IF[,IF...]",
    "can",
    20,
    "  amb-rig --rig flexible_rotor --port can:vcan0 --pace realtime"};

/// Gives `app` the options, and the examples behind them; parsing it fills `options`, whose port
/// and watchdog become those of the program here.
void AddOptions(CLI::App& app, const PlantProgram& program, PlantOptions& options);

/// Reads the command line; prints help or a usage message itself. False: end with `status`.
[[nodiscard]] bool ReadCommandLine(int argc, char** argv, const PlantProgram& program,
                                   PlantOptions& options, ExitStatus& status);

}  // namespace levitas::plant_run

#pragma once
// Command line of amb-controller.

#include <cstdint>
#include <string>
#include <vector>

#include "common/problem.hpp"
#include "transport/command_policy.hpp"

namespace CLI {  // NOLINT(readability-identifier-naming): the library is called so
class App;
}

namespace levitas::controller_program {

struct ControllerOptions {
  std::string rig;         ///< path or shipped name
  std::string controller;  ///< path or shipped name
  std::string scenario;    ///< path or shipped name; empty: commands come over the network
  std::string port{"lcm"};
  std::string telemetry;  ///< LCM network of state, timing, events, commands; empty: that of port
  std::string key;        ///< file with the key of those who may speak; empty: none
  transport::CommandWish commands{transport::CommandWish::kDefault};
  bool realtime{false};
  double duration_s{0.0};  ///< 0: no limit
  std::string record;      ///< session file; empty: none
  bool overwrite{false};   ///< a session that is there already
  std::string trip_folder{"."};
  std::vector<std::size_t> trip_budget{20, 100};  ///< files that stay in it, and megabytes
  std::int64_t seed{1};                           ///< of the rig's noise, for the session's header
  std::string json;
  double partner_timeout_s{30.0};
  bool require_realtime{false};
  int processor{-1};
  int life_line{-1};     ///< pipe whose other end is held by who started us; -1: nobody's
  bool no_lines{false};  ///< leave the rig file's lines alone
};

inline constexpr const char* kName = "amb-controller";
inline constexpr const char* kDescription =
    "Magnetic bearing controller: levitates the rig it finds on its port";

/// Gives `app` the options, and the examples behind them; parsing it fills `options`.
void AddOptions(CLI::App& app, ControllerOptions& options);

/// Reads the command line; prints help or a usage message itself. False: end with `status`.
[[nodiscard]] bool ReadCommandLine(int argc, char** argv, ControllerOptions& options,
                                   ExitStatus& status);

}  // namespace levitas::controller_program

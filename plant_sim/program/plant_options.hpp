#pragma once
// Command line of amb-plant.

#include <cstdint>
#include <string>

#include "common/problem.hpp"

namespace levitas::plant_program {

struct PlantOptions {
  std::string rig;          ///< path or shipped name
  std::string port{"lcm"};  ///< lcm or lcm:URL
  bool realtime{false};
  std::uint64_t seed{1};
  std::string json;  ///< statistics go there; empty: nowhere
  double partner_timeout_s{30.0};
  bool require_realtime{false};
  bool stay{false};  ///< wait for the next controller instead of ending with the present one
};

/// Reads the command line; prints help or a usage message itself. False: end with `status`.
[[nodiscard]] bool ReadCommandLine(int argc, char** argv, PlantOptions& options,
                                   ExitStatus& status);

}  // namespace levitas::plant_program

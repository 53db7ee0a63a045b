#pragma once
// Options of the commands that listen to a run on the network: where it is, who may speak there.
//
// Thread: any. Failure: none here; transport/lcm_network.hpp refuses what cannot be read.

#include <CLI/CLI.hpp>
#include <string>

namespace levitas::cli {

inline void AddNetworkOptions(CLI::App& command, std::string& port, std::string& key) {
  command
      .add_option("--port", port,
                  "Where the run is: lcm, or lcm:udpm://<group>:<port>?ttl=<n> as amb run "
                  "prints it")
      ->capture_default_str();
  command.add_option("--key", key,
                     "File with the key of those who may speak on that network (amb key)");
}

}  // namespace levitas::cli

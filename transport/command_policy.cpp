#include "transport/command_policy.hpp"

#include <fmt/core.h>

#include "common/problem.hpp"
#include "transport/network_key.hpp"

namespace levitas::transport {

CommandPolicy DecideCommands(CommandWish wish, const LcmNetwork& network, bool real_bus) {
  if (wish == CommandWish::kNo) return {false, "nobody over the network (--no-commands)"};
  if (wish == CommandWish::kDefault && real_bus && !network.key) {
    return {false,
            "nobody over the network: the bus is a real one (--key FILE lets those with the key, "
            "--commands every program of this machine)"};
  }
  const std::string url = network.Url(Direction::kCommand);
  if (network.key) {
    return {true,
            fmt::format("whoever has the key {}, {} at {}", network.key->path(),
                        network.this_machine_only() ? "on this machine" : "on any machine", url)};
  }
  if (network.this_machine_only()) {
    return {true,
            fmt::format("every program of this machine, at {} on the loopback interface", url)};
  }
  throw Problem(ExitStatus::kUsage,
                fmt::format("{}: every machine that this network reaches could command the rig; "
                            "name the key of those who may with --key FILE (`amb key FILE` makes "
                            "one), or take no commands with --no-commands",
                            url));
}

}  // namespace levitas::transport

#pragma once
// Whether a controller takes commands over the network, and who could then give them.
//
// Default  yes; on a real bus only with a key, since there a command moves a real rotor. --commands
//          and --no-commands say otherwise.
// Failure  Decide: Problem (exit status 2) for commands on a network that other machines reach
//          without a key.

#include <cstdint>
#include <string>

#include "transport/lcm_network.hpp"

namespace levitas::transport {

enum class CommandWish : std::uint8_t { kDefault, kYes, kNo };

struct CommandPolicy {
  bool open{};      ///< commands are taken
  std::string who;  ///< one sentence for people
};

/// `real_bus`: the rig stands behind an interface that is not a virtual one.
[[nodiscard]] CommandPolicy DecideCommands(CommandWish wish, const LcmNetwork& network,
                                           bool real_bus);

}  // namespace levitas::transport

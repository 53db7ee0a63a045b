#pragma once
// amb identify live (see identify_commands.hpp of the others).

#include "cli/commands/command.hpp"

namespace levitas::cli {

void AddIdentifyLive(CLI::App& identify, Action& action);

}  // namespace levitas::cli

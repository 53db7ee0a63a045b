#pragma once
// amb bench diagnosis: how often the diagnosis names what was hidden (trials/). As in command.hpp.

#include "cli/command.hpp"

namespace levitas::cli {

void AddBenchCommand(CLI::App& app, Action& action);

}  // namespace levitas::cli

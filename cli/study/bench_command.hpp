#pragma once
// amb bench: how often the diagnosis names what was hidden, how near an identification comes to the
// truth (trials/). As in command.hpp.

#include "cli/commands/command.hpp"

namespace levitas::cli {

void AddBenchCommand(CLI::App& app, Action& action);

}  // namespace levitas::cli

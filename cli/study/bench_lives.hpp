#pragma once
// amb bench lives: faulty lives of a rig in virtual time. As in command.hpp.

#include "cli/commands/command.hpp"

namespace levitas::cli {

void AddBenchLives(CLI::App& bench, Action& action);

}  // namespace levitas::cli

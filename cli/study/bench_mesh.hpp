#pragma once
// amb bench mesh: geared rigs without current, with the law, and with synchronous control. As in
// command.hpp.

#include "cli/commands/command.hpp"

namespace levitas::cli {

void AddBenchMesh(CLI::App& bench, Action& action);

}  // namespace levitas::cli

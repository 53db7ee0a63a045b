#pragma once
// What `amb` and `amb-study` have in common: from the command line to the exit status.
//
// Thread   main. Failure: every error becomes one message on standard error and a status of the
//          contract (common/problem.hpp); nothing is thrown out of RunProgram.

#include <functional>

#include "cli/commands/command.hpp"

namespace levitas::cli {

/// May throw Problem, as an action may.
using AddCommands = std::function<void(CLI::App& app, Action& action)>;

/// Parses, runs the command, and returns the exit status. `help COMMAND` is `COMMAND --help`; argv
/// is changed to that.
[[nodiscard]] int RunProgram(int argc, char** argv, const AddCommands& add_commands);

}  // namespace levitas::cli

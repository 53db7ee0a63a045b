#pragma once
// One `amb` command per source file: each adds its subcommand, options and action to the program.
//
// An action returns the exit status of the contract, or throws Problem, which main() prints as one
// message. Every command that computes takes --json FILE beside what it prints for people.

#include <CLI/App.hpp>
#include <functional>

#include "common/problem.hpp"

namespace levitas::cli {

/// Set by the parsed subcommand; run by main() after parsing.
using Action = std::function<ExitStatus()>;

// The commands, in the order of the help. Each is defined in <name>_command.cpp.
// (Add: declaration here, entry in running_commands.cpp, or in study/main.cpp and
// study_commands.hpp, source in CMakeLists.txt.)
void AddRunningCommands(CLI::App& app, Action& action);
void AddRunCommand(CLI::App& app, Action& action);
void AddNewCommand(CLI::App& app, Action& action);
void AddModesCommand(CLI::App& app, Action& action);
void AddPolesCommand(CLI::App& app, Action& action);
void AddMarginsCommand(CLI::App& app, Action& action);
void AddCompareCommand(CLI::App& app, Action& action);
void AddTrendCommand(CLI::App& app, Action& action);
void AddReplayCommand(CLI::App& app, Action& action);
void AddImportCommand(CLI::App& app, Action& action);
void AddExportCommand(CLI::App& app, Action& action);
void AddCanDbcCommand(CLI::App& app, Action& action);
void AddDashCommand(CLI::App& app, Action& action);
void AddSessionsCommand(CLI::App& app, Action& action);
void AddDoctorCommand(CLI::App& app, Action& action);
void AddKeyCommand(CLI::App& app, Action& action);
void AddSimulateCommand(CLI::App& app, Action& action);
void AddEffectsCommand(CLI::App& app, Action& action);
void AddIdentifyCommand(CLI::App& app, Action& action);
void AddDesignCommand(CLI::App& app, Action& action);
void AddBalanceCommand(CLI::App& app, Action& action);
void AddDiagnoseCommand(CLI::App& app, Action& action);
void AddManualCommand(CLI::App& app, Action& action);

}  // namespace levitas::cli

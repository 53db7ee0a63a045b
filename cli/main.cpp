// amb: the command line of the project. Dispatches to one command; see command.hpp.

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "cli/command.hpp"

int main(int argc, char** argv) {
  using namespace levitas;
  CLI::App app{"Levitas: active magnetic bearing controller and its hardware-in-the-loop bench",
               "amb"};
  app.require_subcommand(1);
  cli::Action action;
  cli::AddRunCommand(app, action);
  cli::AddModesCommand(app, action);
  cli::AddPolesCommand(app, action);
  cli::AddMarginsCommand(app, action);
  cli::AddReplayCommand(app, action);
  cli::AddImportCommand(app, action);
  cli::AddExportCommand(app, action);
  cli::AddDoctorCommand(app, action);
  cli::AddSimulateCommand(app, action);
  try {
    app.parse(argc, argv);
    return static_cast<int>(action ? action() : ExitStatus::kUsage);
  } catch (const CLI::ParseError& error) {
    const int code = app.exit(error);
    return code == 0 ? 0 : static_cast<int>(ExitStatus::kUsage);
  } catch (const Problem& problem) {
    fmt::print(stderr, "amb: {}\n", problem.what());
    return static_cast<int>(problem.status());
  } catch (const std::exception& error) {
    fmt::print(stderr, "amb: {}\n", error.what());
    return static_cast<int>(ExitStatus::kOther);
  }
}

// amb: runs, replays and judges a rig; starts amb-study for the other commands.

#include <CLI/App.hpp>

#include "cli/build_mark.hpp"
#include "cli/commands/study_commands.hpp"
#include "cli/program.hpp"

int main(int argc, char** argv) {
  using namespace levitas;
  return cli::RunProgram(argc, argv, [&](CLI::App& app, cli::Action& action) {
    if (argc > 1 && cli::FindStudyCommand(argv[1]) != nullptr) {
      cli::StartStudy(argv, BuildMark());
    }
    cli::AddRunningCommands(app, action);
    // For the list of commands only.
    for (const cli::StudyCommand& command : cli::kStudyCommands) {
      (void)cli::AddStudyCommand(app, command.name);
    }
  });
}

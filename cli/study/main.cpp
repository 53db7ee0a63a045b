// amb-study: every command, those of identification and diagnosis included. Started by amb.

#include "cli/build_mark.hpp"
#include "cli/commands/study_commands.hpp"
#include "cli/program.hpp"
#include "cli/study/bench_command.hpp"

namespace {

void AddCommands(CLI::App& app, levitas::cli::Action& action) {
  using namespace levitas::cli;
  RefuseOtherBuild(levitas::BuildMark());
  AddRunningCommands(app, action);
  AddImportCommand(app, action);
  AddSimulateCommand(app, action);
  AddEffectsCommand(app, action);
  AddIdentifyCommand(app, action);
  AddDesignCommand(app, action);
  AddBalanceCommand(app, action);
  AddDiagnoseCommand(app, action);
  AddBenchCommand(app, action);
  AddManualCommand(app, action);
}

}  // namespace

int main(int argc, char** argv) { return levitas::cli::RunProgram(argc, argv, AddCommands); }

#include "cli/commands/command.hpp"
#include "cli/commands/report_command.hpp"

namespace levitas::cli {

void AddRunningCommands(CLI::App& app, Action& action) {
  AddRunCommand(app, action);
  AddNewCommand(app, action);
  AddModesCommand(app, action);
  AddPolesCommand(app, action);
  AddMarginsCommand(app, action);
  AddReplayCommand(app, action);
  AddExportCommand(app, action);
  AddCanDbcCommand(app, action);
  AddDashCommand(app, action);
  AddReportCommand(app, action);
  AddCompareCommand(app, action);
  AddTrendCommand(app, action);
  AddSessionsCommand(app, action);
  AddDoctorCommand(app, action);
  AddKeyCommand(app, action);
}

}  // namespace levitas::cli

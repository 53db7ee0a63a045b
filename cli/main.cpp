// amb: the command line of the project. Dispatches to one command; see command.hpp.

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <vector>

#include "cli/bench_command.hpp"
#include "cli/command.hpp"
#include "cli/report_command.hpp"
#include "common/nearest.hpp"
#include "controller/rt/say.hpp"

namespace {

/// A first word that is no command gets its own answer: CLI11 would only ask for a subcommand.
void RefuseUnknownCommand(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  const std::string found = argv[1];
  std::vector<std::string> known{"test", "package"};  // of the launcher, ./amb
  for (const CLI::App* command : app.get_subcommands({})) known.push_back(command->get_name());
  if (std::find(known.begin() + 2, known.end(), found) != known.end()) return;
  throw levitas::Problem(levitas::ExitStatus::kUsage,
                         fmt::format("no command '{}'; nearest: {}. All: {}", found,
                                     levitas::Nearest(found, known), levitas::Listed(known)));
}

/// The option parser's sentence, and for a misspelt option the one that was likely meant.
std::string UsageText(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App* command = &app;
  std::string path = app.get_name();
  while (!command->get_subcommands().empty()) {
    command = command->get_subcommands().front();
    path += " " + command->get_name();
  }
  std::vector<std::string> known;
  for (const CLI::Option* option : command->get_options()) {
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  }
  std::string text = error.what();
  for (const std::string& word : app.remaining(true)) {
    const std::string meant = word.starts_with("--") ? levitas::LikelyMeant(word, known) : "";
    if (!meant.empty()) text += fmt::format("; nearest to {}: {}", word, meant);
  }
  return fmt::format("{}; see {} --help", text, path);
}

int Main(int argc, char** argv) {
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
  cli::AddCanDbcCommand(app, action);
  cli::AddDashCommand(app, action);
  cli::AddReportCommand(app, action);
  cli::AddSessionsCommand(app, action);
  cli::AddDoctorCommand(app, action);
  cli::AddKeyCommand(app, action);
  cli::AddSimulateCommand(app, action);
  cli::AddEffectsCommand(app, action);
  cli::AddIdentifyCommand(app, action);
  cli::AddDiagnoseCommand(app, action);
  cli::AddBenchCommand(app, action);
  cli::AddManualCommand(app, action);
  try {
    RefuseUnknownCommand(app, argc, argv);
    app.parse(argc, argv);
    return static_cast<int>(action ? action() : ExitStatus::kUsage);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help
    rt::Say(fmt::format("amb: {}", UsageText(app, error)));
    return static_cast<int>(ExitStatus::kUsage);
  } catch (const Problem& problem) {
    rt::Say(fmt::format("amb: {}", problem.what()));
    return static_cast<int>(problem.status());
  } catch (const std::exception& error) {
    rt::Say(fmt::format("amb: {}", error.what()));
    return static_cast<int>(ExitStatus::kOther);
  }
}

}  // namespace

int main(int argc, char** argv) {
  levitas::rt::OpenStandardFiles();
  const int status = Main(argc, argv);
  static_cast<void>(levitas::rt::FlushSaid());
  return status;
}

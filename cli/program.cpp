#include "cli/program.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <new>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "cli/commands/command.hpp"
#include "cli/json_file.hpp"
#include "cli/output_clash.hpp"
#include "cli/standard_output.hpp"
#include "common/nearest.hpp"
#include "common/output_file.hpp"
#include "levitas_version.hpp"
#include "rt/limits.hpp"
#include "rt/say.hpp"

namespace levitas::cli {

namespace {

/// A first word that is no command gets its own answer: CLI11 would only ask for a subcommand.
void RefuseUnknownCommand(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  const std::string found = argv[1];
  if (found == "test" || found == "package") {
    throw Problem(
        ExitStatus::kUsage,
        fmt::format("'{0}' is of the launcher: ./amb {0} in the folder of the source", found));
  }
  std::vector<std::string> known{"help"};  // the parser's own
  for (const CLI::App* command : app.get_subcommands({})) known.push_back(command->get_name());
  if (std::find(known.begin(), known.end(), found) != known.end()) return;
  throw Problem(ExitStatus::kUsage, fmt::format("no command '{}'; nearest: {}. All: {}", found,
                                                Nearest(found, known), Listed(known)));
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
    const std::string meant = word.starts_with("--") ? LikelyMeant(word, known) : "";
    if (!meant.empty()) text += fmt::format("; nearest to {}: {}", word, meant);
  }
  return fmt::format("{}; see {} --help", text, path);
}

/// Of --help and --version.
int TellHelp(const CLI::App& app, const CLI::ParseError& error) {
  std::ostringstream text;
  const int status = app.exit(error, text, text);
  fmt::print("{}", text.str());
  return status;
}

/// "help margins" is "margins --help", and "help" alone is "--help".
void TakeHelpAsOption(int argc, char** argv) {
  if (argc < 2 || std::string_view(argv[1]) != "help") return;
  static std::array<char, 7> option{"--help"};
  std::rotate(argv + 1, argv + 2, argv + argc);
  argv[argc - 1] = option.data();
}

/// The command that was parsed, and whether its JSON is asked for on standard output.
void PrepareJson(const CLI::App& app, StandardOutput& output) {
  const CLI::App* command = &app;
  std::string name;
  while (!command->get_subcommands().empty()) {
    command = command->get_subcommands().front();
    name += (name.empty() ? "" : "_") + command->get_name();
  }
  NameJson(name);
  const CLI::Option* json = command->get_option_no_throw("--json");
  if (json != nullptr && json->count() > 0 && json->as<std::string>() == kJsonToStandardOutput) {
    output.GiveWayToData();
  }
}

/// The parser's ranges let "nan" pass, which is neither below nor above anything.
void RefuseNoNumbers(const CLI::App& app) {
  for (const CLI::App* command : app.get_subcommands()) {
    for (const CLI::Option* option : command->get_options()) {
      if (!option->get_type_name().starts_with("FLOAT")) continue;
      for (const std::string& word : option->results()) {
        if (!std::isnan(std::strtod(word.c_str(), nullptr))) continue;
        throw Problem(ExitStatus::kUsage,
                      fmt::format("{}: found {}, which is no number", option->get_name(), word));
      }
    }
    RefuseNoNumbers(*command);
  }
}

int Parse(int argc, char** argv, const AddCommands& add_commands, StandardOutput& output) {
  CLI::App app{"Levitas: active magnetic bearing controller and its hardware-in-the-loop bench",
               "amb"};
  app.set_version_flag("--version", "levitas " LEVITAS_VERSION);
  app.require_subcommand(1);
  Action action;
  try {
    add_commands(app, action);
    RefuseUnknownCommand(app, argc, argv);
    app.parse(argc, argv);
    RefuseNoNumbers(app);
    RefuseClashes(app);
    PrepareJson(app, output);
    return static_cast<int>(action ? action() : ExitStatus::kUsage);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return TellHelp(app, error);
    rt::Say(fmt::format("amb: {}", UsageText(app, error)));
    return static_cast<int>(ExitStatus::kUsage);
  } catch (const Problem& problem) {
    rt::Say(fmt::format("amb: {}", problem.what()));
    return static_cast<int>(problem.status());
  } catch (const std::bad_alloc&) {
    rt::Say("amb: not enough memory for this");
    return static_cast<int>(ExitStatus::kOther);
  } catch (const std::exception& error) {
    rt::Say(fmt::format("amb: {}", error.what()));
    return static_cast<int>(ExitStatus::kOther);
  }
}

}  // namespace

int RunProgram(int argc, char** argv, const AddCommands& add_commands) {
  rt::OpenStandardFiles();
  if (!rt::EnsureStack("amb")) return static_cast<int>(ExitStatus::kOther);
  TakeHelpAsOption(argc, argv);
  StandardOutput output;
  int status = Parse(argc, argv, add_commands, output);
  if (const auto kept = TakeKeptNames(); !kept.empty()) {
    rt::Say(fmt::format("amb: earlier files of other content are kept: {}", Listed(kept)));
  }
  if (const std::string& refused = output.Finish(); !refused.empty()) {
    rt::Say(fmt::format("amb: standard output: writing failed: {}; not all of the result was told",
                        refused));
    if (status == static_cast<int>(ExitStatus::kDone))
      status = static_cast<int>(ExitStatus::kOther);
  }
  static_cast<void>(rt::FlushSaid());
  return status;
}

}  // namespace levitas::cli

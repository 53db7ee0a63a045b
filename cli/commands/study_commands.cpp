#include "cli/commands/study_commands.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>

namespace levitas::cli {

const StudyCommand* FindStudyCommand(std::string_view name) {
  const auto* found = std::find_if(kStudyCommands.begin(), kStudyCommands.end(),
                                   [&](const auto& known) { return known.name == name; });
  return found == kStudyCommands.end() ? nullptr : found;
}

CLI::App* AddStudyCommand(CLI::App& app, std::string_view name) {
  const StudyCommand* command = FindStudyCommand(name);
  if (command == nullptr) throw std::logic_error(fmt::format("'{}' is not in the list", name));
  return app.add_subcommand(command->name, command->meaning);
}

namespace {

/// amb-study in the folder of the program that runs.
std::string StudyPath() {
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) {
    throw Problem(ExitStatus::kOther, "/proc/self/exe: " + error.message() +
                                          "; without it amb does not find amb-study");
  }
  return (self.parent_path() / "amb-study").string();
}

}  // namespace

void StartStudy(char** argv, const char* mark) {
  const std::string program = StudyPath();
  setenv(kStartedBy, mark, 1);
  execv(program.c_str(), argv);
  throw Problem(ExitStatus::kOther,
                fmt::format("{}: {}. amb {} is a part of amb-study, which `./amb {}` builds: "
                            "once, some ten minutes on two cores",
                            program, std::strerror(errno), argv[1], argv[1]));
}

void RefuseOtherBuild(const char* mark) {
  const char* starter = std::getenv(kStartedBy);
  if (starter == nullptr || std::string_view(starter) == mark) return;
  throw Problem(
      ExitStatus::kOther,
      fmt::format("{} is of another build (mark {}) than the amb beside it (mark {}), so that the "
                  "two may read and compute differently; `ninja programs` in the build folder, or "
                  "any command through ./amb, builds both",
                  StudyPath(), mark, starter));
}

}  // namespace levitas::cli

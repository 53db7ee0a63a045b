// amb manual: the command line written down, for docs/, man and the shell.

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "cli/commands/command.hpp"
#include "cli/commands/study_commands.hpp"
#include "cli/study/manual/manual.hpp"
#include "levitas_version.hpp"

namespace levitas::cli {

void AddManualCommand(CLI::App& app, Action& action) {
  enum class Form { kNone, kMarkdown, kMan, kBash };
  auto form = std::make_shared<Form>(Form::kNone);
  auto of = std::make_shared<std::string>("amb");
  CLI::App* command = AddStudyCommand(app, "manual");
  const auto add = [&](const char* name, Form value, const char* meaning) {
    return command->add_flag_callback(
        name, [form, value] { *form = value; }, meaning);
  };
  CLI::Option* markdown = add("--markdown", Form::kMarkdown, "Print the page docs/commands.md");
  CLI::Option* man =
      add("--man", Form::kMan, "Print the manual page amb(1), or that of another program")
          ->excludes(markdown);
  add("--bash", Form::kBash, "Print completion for bash")->excludes(markdown)->excludes(man);
  command->add_option("--of", *of, "With --man: the program")
      ->check(CLI::IsMember({"amb", "amb-controller", "amb-plant", "amb-rig", "amb-study"}))
      ->needs(man)
      ->capture_default_str();
  command->footer(
      "  source <(./amb manual --bash)        # in ~/.bashrc; zsh: autoload bashcompinit first\n"
      "  ./amb manual --man | man -l -\n"
      "  ./amb manual --man --of amb-controller | man -l -");
  command->callback([form, of, &app, &action] {
    action = [form, of, &app] {
      const CommandText tree = TreeOf(app);
      if (*form == Form::kNone) {
        throw Problem(ExitStatus::kUsage, "nothing to print: --markdown, --man or --bash");
      }
      const std::vector<ProgramText> programs = OtherPrograms();
      const auto other = std::ranges::find(
          programs, *of, [](const ProgramText& program) { return program.line.name; });
      fmt::print("{}", *form == Form::kMarkdown  ? Markdown(tree, programs)
                       : *form == Form::kBash    ? BashCompletion(tree, programs)
                       : other == programs.end() ? ManPage(tree, LEVITAS_VERSION)
                                                 : ManPage(*other, LEVITAS_VERSION));
      return ExitStatus::kDone;
    };
  });
}

}  // namespace levitas::cli

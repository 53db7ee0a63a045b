// amb manual: the command line written down, for docs/, man and the shell.

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "cli/commands/command.hpp"
#include "cli/commands/study_commands.hpp"
#include "cli/study/manual/manual.hpp"
#include "levitas_version.hpp"

namespace levitas::cli {

void AddManualCommand(CLI::App& app, Action& action) {
  enum class Form { kNone, kMarkdown, kMan, kBash };
  auto form = std::make_shared<Form>(Form::kNone);
  CLI::App* command = AddStudyCommand(app, "manual");
  const auto add = [&](const char* name, Form value, const char* meaning) {
    return command->add_flag_callback(
        name, [form, value] { *form = value; }, meaning);
  };
  CLI::Option* markdown = add("--markdown", Form::kMarkdown, "Print the page docs/commands.md");
  CLI::Option* man = add("--man", Form::kMan, "Print the manual page amb(1)")->excludes(markdown);
  add("--bash", Form::kBash, "Print completion for bash")->excludes(markdown)->excludes(man);
  command->footer(
      "  source <(./amb manual --bash)        # in ~/.bashrc; zsh: autoload bashcompinit first\n"
      "  ./amb manual --man | man -l -");
  command->callback([form, &app, &action] {
    action = [form, &app] {
      const CommandText tree = TreeOf(app);
      if (*form == Form::kNone) {
        throw Problem(ExitStatus::kUsage, "nothing to print: --markdown, --man or --bash");
      }
      fmt::print("{}", *form == Form::kMarkdown ? Markdown(tree)
                       : *form == Form::kMan    ? ManPage(tree, LEVITAS_VERSION)
                                                : BashCompletion(tree));
      return ExitStatus::kDone;
    };
  });
}

}  // namespace levitas::cli

#include <fmt/core.h>

#include "cli/study/manual/manual.hpp"

namespace levitas::cli {
namespace {

/// Within a cell of a table a bar would end it.
std::string Cell(const std::string& text) {
  std::string cell;
  for (const char c : text) {
    if (c == '|') cell += '\\';
    cell += c;
  }
  return cell;
}

std::string Row(const OptionText& option) {
  std::string name = option.name;
  if (option.takes_value && !option.positional) name += " " + option.value;
  std::string meaning = option.meaning;
  if (option.positional && !option.allowed.empty()) meaning += ": " + option.value;
  if (option.required) meaning += " (needed)";
  if (!option.preset.empty()) meaning += " (default " + option.preset + ")";
  return fmt::format("| `{}` | {} |\n", Cell(name), Cell(meaning));
}

std::string MarkdownSection(const CommandText& command) {
  std::string text = fmt::format("\n## {}\n\n{}.\n", command.path, command.meaning);
  if (!command.options.empty()) {
    text += "\n| | |\n|---|---|\n";
    for (const OptionText& option : command.options) text += Row(option);
  }
  if (!command.examples.empty()) text += "\n```text\n" + command.examples + "\n```\n";
  for (const CommandText& inner : command.commands) text += MarkdownSection(inner);
  return text;
}

}  // namespace

std::string Markdown(const CommandText& root, const std::vector<ProgramText>& programs) {
  std::string text =
      "# Commands\n\n"
      "Written by `amb manual --markdown`; the same texts stand in `--help` of each command.\n\n"
      "Exit status: 0 done, 2 usage, 3 bad input file, 4 the rig tripped, 5 what --require asked "
      "is not met, 1 other.\n\n"
      "| command | |\n|---|---|\n";
  for (const CommandText& command : root.commands) {
    text += fmt::format("| `{}` | {} |\n", command.path, Cell(command.meaning));
  }
  for (const CommandText& command : root.commands) text += MarkdownSection(command);
  for (const ProgramText& program : programs) {
    text += MarkdownSection(program.line) + "\n" + program.about +
            "\n\nExit status: " + program.exit_status + "\n";
  }
  return text;
}

}  // namespace levitas::cli

#include <fmt/core.h>

#include <algorithm>

#include "cli/study/manual/manual.hpp"

namespace levitas::cli {
namespace {

/// Text of a paragraph: what troff would take for its own is escaped.
std::string Escaped(const std::string& text) {
  std::string safe;
  bool line_start = true;
  for (const char c : text) {
    if (line_start && (c == '.' || c == '\'')) safe += "\\&";
    if (c == '\\') {
      safe += "\\e";
    } else if (c == '-') {
      safe += "\\-";
    } else {
      safe += c;
    }
    line_start = c == '\n';
  }
  return safe;
}

std::string UpperCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](char c) {
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  });
  return text;
}

std::string Option(const OptionText& option) {
  std::string name = "\\fB" + Escaped(option.name) + "\\fR";
  if (option.takes_value && !option.positional) name += " \\fI" + Escaped(option.value) + "\\fR";
  std::string meaning = option.meaning;
  if (option.required) meaning += " (needed)";
  if (!option.preset.empty()) meaning += " (default " + option.preset + ")";
  return fmt::format(".TP\n{}\n{}.\n", name, Escaped(meaning));
}

std::string ManSection(const CommandText& command) {
  std::string text = fmt::format(".SS {}\n{}.\n", Escaped(command.path), Escaped(command.meaning));
  for (const OptionText& option : command.options) text += Option(option);
  if (!command.examples.empty()) {
    text += ".PP\n.nf\n" + Escaped(command.examples) + "\n.fi\n";
  }
  for (const CommandText& inner : command.commands) text += ManSection(inner);
  return text;
}

}  // namespace

std::string ManPage(const CommandText& root, const std::string& version) {
  std::string text = fmt::format(
      ".TH {0} 1 \"\" \"levitas {1}\" \"Levitas\"\n"
      ".SH NAME\n{2} \\- {3}\n"
      ".SH SYNOPSIS\n.B {2}\n\\fICOMMAND\\fR [\\fIOPTIONS\\fR]\n"
      ".SH COMMANDS\n",
      UpperCase(root.name), version, root.name, Escaped(root.meaning));
  for (const CommandText& command : root.commands) text += ManSection(command);
  text +=
      ".SH EXIT STATUS\n0 done, 2 usage, 3 bad input file, 4 the rig tripped, 1 other.\n"
      ".SH ENVIRONMENT\n"
      ".TP\n\\fBLEVITAS_CONFIG\\fR\nFolder with rigs, controllers and scenarios, instead of the "
      "shipped ones.\n"
      ".TP\n\\fBLEVITAS_CATALOGUE\\fR\nSQLite file of \\fBamb sessions\\fR; empty: none.\n";
  return text;
}

}  // namespace levitas::cli

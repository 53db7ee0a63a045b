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

std::string ManHead(const CommandText& line, const std::string& version) {
  return fmt::format(
      ".TH {0} 1 \"\" \"levitas {1}\" \"Levitas\"\n"
      ".SH NAME\n{2} \\- {3}\n",
      UpperCase(Escaped(line.name)), version, Escaped(line.name), Escaped(line.meaning));
}

std::string ManFiles(const ProgramText& program) {
  if (program.files.empty()) return {};
  std::string text = ".SH FILES\n";
  for (const auto& [name, meaning] : program.files) {
    text += fmt::format(".TP\n\\fI{}\\fR\n{}.\n", Escaped(name), Escaped(meaning));
  }
  return text;
}

constexpr const char* kManConfigFolder =
    ".TP\n\\fBLEVITAS_CONFIG\\fR\nFolder with rigs, controllers and scenarios, instead of the "
    "shipped ones.\n";

}  // namespace

std::string ManPage(const ProgramText& program, const std::string& version) {
  const CommandText& line = program.line;
  const bool of_its_own = !line.options.empty();
  std::string text = ManHead(line, version);
  text += fmt::format(".SH SYNOPSIS\n.B {}\n{}[\\fIOPTIONS\\fR]\n", Escaped(line.name),
                      of_its_own ? "" : "\\fICOMMAND\\fR ");
  text += ".SH DESCRIPTION\n" + Escaped(program.about) + "\n";
  if (of_its_own) text += ".SH OPTIONS\n";
  for (const OptionText& option : line.options) text += Option(option);
  text += ".SH EXIT STATUS\n" + Escaped(program.exit_status) + "\n" + ManFiles(program);
  text += fmt::format(".SH ENVIRONMENT\n{}", kManConfigFolder);
  if (!line.examples.empty()) {
    text += ".SH EXAMPLES\n.nf\n" + Escaped(line.examples) + "\n.fi\n";
  }
  return text + ".SH SEE ALSO\n.BR amb (1)\n";
}

std::string ManPage(const CommandText& root, const std::string& version) {
  std::string text = ManHead(root, version);
  text += fmt::format(".SH SYNOPSIS\n.B {}\n\\fICOMMAND\\fR [\\fIOPTIONS\\fR]\n.SH COMMANDS\n",
                      root.name);
  for (const CommandText& command : root.commands) text += ManSection(command);
  text +=
      ".SH EXIT STATUS\n0 done, 2 usage, 3 bad input file, 4 the rig tripped, 5 what "
      "\\fB\\-\\-require\\fR asked is not met, 1 other.\n"
      ".SH ENVIRONMENT\n";
  text += kManConfigFolder;
  text +=
      ".TP\n\\fBLEVITAS_CATALOGUE\\fR\nSQLite file of \\fBamb sessions\\fR; empty: none.\n"
      ".SH SEE ALSO\n"
      ".BR amb\\-controller (1),\n.BR amb\\-plant (1),\n.BR amb\\-rig (1),\n.BR amb\\-study (1)\n";
  return text;
}

}  // namespace levitas::cli

#include <fmt/core.h>

#include "cli/study/manual/manual.hpp"
#include "configuration/shipped_names.hpp"

namespace levitas::cli {
namespace {

std::string Joined(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + word;
  return line;
}

/// What may follow an option; "<files>" where anything may.
std::string ValuesOf(const OptionText& option) {
  if (!option.allowed.empty()) return Joined(option.allowed);
  for (const auto& [name, kind] : {std::pair{"--rig", "rigs"}, std::pair{"--scenario", "scenarios"},
                                   std::pair{"--controller", "controllers"}}) {
    if (option.name == name) return "<files> " + Joined(configuration::ShippedNames(kind));
  }
  return "<files>";
}

/// Lines of two associative arrays: the words of a command, and of an option that takes a value.
void Fill(const CommandText& command, std::string& words, std::string& values) {
  std::vector<std::string> all;
  for (const CommandText& inner : command.commands) all.push_back(inner.name);
  for (const OptionText& option : command.options) {
    if (option.positional) {
      all.insert(all.end(), option.allowed.begin(), option.allowed.end());
      continue;
    }
    for (const std::string& name : option.names) {
      all.push_back(name);
      if (!option.takes_value) continue;
      values += fmt::format("  ['{} {}']='{}'\n", command.path, name, ValuesOf(option));
    }
  }
  words += fmt::format("  ['{}']='{}'\n", command.path, Joined(all));
  for (const CommandText& inner : command.commands) Fill(inner, words, values);
}

// The word before decides: behind an option its values, else the options and commands of the
// command that the words so far have named.
constexpr const char* kFunction = R"(
_amb() {
  local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} word words
  local at=${COMP_WORDS[0]##*/}
  [[ $at == amb-study ]] && at=amb
  for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
    [[ -n ${_amb_words["$at $word"]+known} ]] && at+=" $word"
  done
  words=${_amb_values["$at $before"]-${_amb_words[$at]}}
  COMPREPLY=($(compgen -W "${words//<files>/}" -- "$current"))
  if [[ $words == *'<files>'* || ( $current != -* && -z ${COMPREPLY[*]} ) ]]; then
    compopt -o filenames 2>/dev/null
    local name
    while IFS= read -r name; do COMPREPLY+=("$name"); done < <(compgen -f -- "$current")
  fi
}
complete -F _amb amb amb-study amb-controller amb-plant amb-rig
)";

}  // namespace

std::string BashCompletion(const CommandText& root, const std::vector<ProgramText>& programs) {
  std::string words;
  std::string values;
  Fill(root, words, values);
  for (const ProgramText& program : programs) {
    if (!program.line.options.empty()) Fill(program.line, words, values);
  }
  return "# Completion of amb and its programs for bash: source <(amb manual --bash)\n"
         "declare -gA _amb_words=(\n" +
         words + ")\ndeclare -gA _amb_values=(\n" + values + ")" + kFunction;
}

}  // namespace levitas::cli

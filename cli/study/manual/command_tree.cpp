#include "cli/study/manual/command_tree.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>

namespace levitas::cli {
namespace {

std::vector<std::string> AtCommas(const std::string& list) {
  std::vector<std::string> words{""};
  for (const char c : list) {
    if (c == ',') {
      words.emplace_back();
    } else {
      words.back() += c;
    }
  }
  return words;
}

/// The words of "{a,b}" within what CLI11 says of a value's type and checks; of "{a->0,b->1}",
/// where words stand for values, the words.
std::vector<std::string> AllowedIn(const std::string& type) {
  const std::size_t open = type.find('{');
  const std::size_t close = type.find('}', open);
  if (open == std::string::npos || close == std::string::npos) return {};
  std::vector<std::string> words = AtCommas(type.substr(open + 1, close - open - 1));
  for (std::string& word : words) word.resize(std::min(word.size(), word.find("->")));
  return words;
}

std::string InBraces(const std::vector<std::string>& words) {
  std::string list;
  for (const std::string& word : words) list += (list.empty() ? "{" : ",") + word;
  return list + "}";
}

/// " (1 to 20)" of "UINT:INT in [1 - 20]"; empty when no range is checked.
std::string RangeIn(const std::string& type) {
  const std::size_t open = type.find(" in [");
  const std::size_t dash = type.find(" - ", open);
  const std::size_t close = type.find(']', open);
  if (open == std::string::npos || dash == std::string::npos || close == std::string::npos) {
    return {};
  }
  return " (" + type.substr(open + 5, dash - open - 5) + " to " +
         type.substr(dash + 3, close - dash - 3) + ")";
}

OptionText TextOf(const CLI::Option& option) {
  OptionText text;
  text.positional = option.get_positional();
  text.name = text.positional ? option.get_name(true) : option.get_name(false, true);
  text.names = AtCommas(text.name);
  text.takes_value = option.get_items_expected_max() > 0;
  const std::string type = text.takes_value ? option.get_type_name() : "";
  text.allowed = AllowedIn(type);
  // "UINT:INT in [1 - 20]": what it is, then what is checked.
  text.value = text.allowed.empty() ? type.substr(0, type.find(':')) : InBraces(text.allowed);
  const bool optional = text.takes_value && option.get_items_expected_min() == 0;
  if (optional) text.value = "[" + text.value + "]";
  text.meaning = option.get_description() + RangeIn(type);
  text.preset = option.get_default_str();
  text.required = option.get_required();
  return text;
}

CommandText Describe(const CLI::App& app, const std::string& above) {
  CommandText text;
  text.name = app.get_name();
  text.path = above.empty() ? text.name : above + " " + text.name;
  text.meaning = app.get_description();
  text.examples = app.get_footer();
  for (const CLI::Option* option : app.get_options()) {
    if (!option->get_group().empty()) text.options.push_back(TextOf(*option));
  }
  for (const CLI::App* command : app.get_subcommands({})) {
    text.commands.push_back(Describe(*command, text.path));
  }
  return text;
}

}  // namespace

CommandText TreeOf(const CLI::App& app) { return Describe(app, ""); }

}  // namespace levitas::cli

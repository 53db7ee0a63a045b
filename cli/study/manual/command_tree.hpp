#pragma once
// The command line as data: one source for the reference page, the manual page and completion.
//
// Thread   any. Failure: none.
// Not done parsing: that is CLI11's.

#include <string>
#include <vector>

namespace CLI {  // NOLINT(readability-identifier-naming): the library is called so
class App;
}

namespace levitas::cli {

struct OptionText {
  std::vector<std::string> names;  ///< each way to write an option, by itself
  std::string name;                ///< "--json", or "SESSION" of a word by position
  std::string value;               ///< what follows, "TEXT" or "{lockstep,realtime}"; may be empty
  std::string meaning;
  std::string preset;                ///< default value; may be empty
  std::vector<std::string> allowed;  ///< the only values, where they are few
  bool positional{};
  bool required{};
  bool takes_value{};
};

struct CommandText {
  std::string name;  ///< "identify"
  std::string path;  ///< "amb identify"
  std::string meaning;
  std::string examples;  ///< the lines behind the options, as they stand in --help
  std::vector<OptionText> options;
  std::vector<CommandText> commands;
};

[[nodiscard]] CommandText TreeOf(const CLI::App& app);

}  // namespace levitas::cli

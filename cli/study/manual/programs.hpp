#pragma once
// The programs beside amb, with what their manual pages say beyond options and examples.
//
// Thread   any. Failure: none.

#include <string>
#include <vector>

#include "cli/study/manual/command_tree.hpp"

namespace levitas::cli {

struct ProgramText {
  CommandText line;         ///< options as the program itself has them; of amb-study none
  std::string about;        ///< a paragraph
  std::string exit_status;  ///< one line
  std::vector<std::pair<std::string, std::string>> files;  ///< name, meaning
};

/// amb-controller, amb-plant, amb-rig, amb-study.
[[nodiscard]] std::vector<ProgramText> OtherPrograms();

}  // namespace levitas::cli

#include "cli/study/written_files.hpp"

#include <fmt/core.h>

#include "cli/json_file.hpp"

namespace levitas::cli {

void TellWritten(const std::vector<std::string>& paths) {
  std::string text;
  for (const std::string& path : paths) {
    if (!path.empty() && path != kJsonToStandardOutput) text += (text.empty() ? "" : ", ") + path;
  }
  if (!text.empty()) fmt::print("\nwrote {}\n", text);
}

}  // namespace levitas::cli

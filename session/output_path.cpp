#include "session/output_path.hpp"

#include <fmt/core.h>

#include <filesystem>

#include "common/problem.hpp"

namespace levitas::session {

void CheckOutputPath(const std::string& output_path, const std::string& input_path) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  if (fs::is_directory(output_path, ignored)) {
    throw BadInput(
        fmt::format("{}: cannot be written: it is a folder. Name a file in it.", output_path));
  }
  if (fs::equivalent(output_path, input_path, ignored)) {
    throw Problem(
        ExitStatus::kUsage,
        fmt::format("{}: what is read and what is written would be the same file", output_path));
  }
}

}  // namespace levitas::session

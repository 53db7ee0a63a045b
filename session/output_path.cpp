#include "session/output_path.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
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
  const std::string folder = fs::path(output_path).parent_path().string();
  if (!output_path.empty() && access(folder.empty() ? "." : folder.c_str(), W_OK | X_OK) != 0) {
    throw BadInput(fmt::format("{}: cannot be written: folder {}: {}", output_path,
                               folder.empty() ? "." : folder, std::strerror(errno)));
  }
  if (fs::equivalent(output_path, input_path, ignored)) {
    throw Problem(
        ExitStatus::kUsage,
        fmt::format("{}: what is read and what is written would be the same file", output_path));
  }
}

void CheckNoRecording(const std::string& path, bool overwrite) {
  namespace fs = std::filesystem;
  std::error_code unknown;
  if (overwrite || !fs::is_regular_file(path, unknown)) return;
  if (const auto size = fs::file_size(path, unknown); unknown || size == 0) return;
  throw Problem(ExitStatus::kUsage,
                fmt::format("{}: is there already, and would be lost. Name another file, or add "
                            "--overwrite",
                            path));
}

}  // namespace levitas::session

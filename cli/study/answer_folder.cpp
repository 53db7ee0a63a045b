#include "cli/study/answer_folder.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "common/problem.hpp"

namespace levitas::cli {

AnswerFolder::AnswerFolder(const std::string& path) {
  std::error_code failed;
  std::filesystem::path missing = std::filesystem::absolute(path, failed).lexically_normal();
  if (!missing.has_filename()) missing = missing.parent_path();
  while (!failed && !std::filesystem::exists(missing, failed) && missing.has_relative_path()) {
    made_.push_back(missing);
    missing = missing.parent_path();
  }
  failed.clear();
  std::filesystem::create_directories(path, failed);
  if (failed) {
    throw BadInput(fmt::format("--out {}: cannot be made a folder ({}); name another", path,
                               failed.message()));
  }
  if (::access(path.c_str(), W_OK | X_OK) != 0) {
    throw BadInput(fmt::format("--out {}: cannot be written to ({}); name another folder", path,
                               std::strerror(errno)));
  }
}

AnswerFolder::~AnswerFolder() {
  std::error_code kept;  // a folder that holds something cannot be removed, and shall not be
  for (const auto& folder : made_) std::filesystem::remove(folder, kept);
}

}  // namespace levitas::cli

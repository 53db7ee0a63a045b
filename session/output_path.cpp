#include "session/output_path.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

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

namespace {

std::string PartPath(const std::string& path) {
  std::error_code ignored;
  const auto kind = std::filesystem::status(path, ignored).type();
  using Type = std::filesystem::file_type;
  return kind == Type::not_found || kind == Type::regular || kind == Type::directory
             ? path + ".part"
             : path;
}

}  // namespace

PartFile::PartFile(std::string path) : path_(std::move(path)), part_path_(PartPath(path_)) {}

PartFile::~PartFile() {
  std::error_code ignored;
  if (!committed_ && part_path_ != path_) std::filesystem::remove(part_path_, ignored);
}

void PartFile::Commit() {
  if (part_path_ != path_) std::filesystem::rename(part_path_, path_);
  committed_ = true;
}

}  // namespace levitas::session

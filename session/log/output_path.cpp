#include "session/log/output_path.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "common/output_file.hpp"
#include "common/problem.hpp"

namespace levitas::session {
namespace {

namespace fs = std::filesystem;

std::string Canonical(const std::string& path) {
  std::error_code none;
  const fs::path found = fs::weakly_canonical(fs::absolute(path, none), none);
  return none ? fs::path(path).lexically_normal().string() : found.string();
}

}  // namespace

bool SameFile(const std::string& one, const std::string& other) {
  std::error_code none;
  const fs::file_status first = fs::status(one, none);
  const fs::file_status second = fs::status(other, none);
  if (fs::exists(first) != fs::exists(second)) return false;
  if (!fs::exists(first)) return Canonical(one) == Canonical(other);
  return fs::is_regular_file(first) && fs::equivalent(one, other, none);
}

void RefuseClash(const std::vector<NamedPath>& written, const std::vector<NamedPath>& read) {
  for (std::size_t i = 0; i < written.size(); ++i) {
    const NamedPath& out = written[i];
    if (out.path.empty()) continue;
    for (const NamedPath& in : read) {
      if (in.path.empty() || !SameFile(out.path, in.path)) continue;
      throw Problem(
          ExitStatus::kUsage,
          fmt::format("{} {}: the same file as {} {}, which is read and would be lost. Name "
                      "another file",
                      out.name, out.path, in.name, in.path));
    }
    for (std::size_t k = 0; k < i; ++k) {
      if (written[k].path.empty() || !SameFile(out.path, written[k].path)) continue;
      throw Problem(ExitStatus::kUsage,
                    fmt::format("{} {} and {} {}: the same file, so one of them would be lost. "
                                "Give each a file of its own",
                                written[k].name, written[k].path, out.name, out.path));
    }
  }
}

void CheckOutputFolder(const std::string& output_path) {
  const std::string folder = fs::path(output_path).parent_path().string();
  if (output_path.empty() || access(folder.empty() ? "." : folder.c_str(), W_OK | X_OK) == 0)
    return;
  throw BadInput(fmt::format("{}: cannot be written: folder {}: {}", output_path,
                             folder.empty() ? "." : folder, std::strerror(errno)));
}

void CheckOutputPath(const std::string& output_path, const std::string& input_path) {
  std::error_code ignored;
  if (fs::is_directory(output_path, ignored)) {
    throw BadInput(
        fmt::format("{}: cannot be written: it is a folder. Name a file in it.", output_path));
  }
  CheckOutputFolder(output_path);
  if (fs::equivalent(output_path, input_path, ignored)) {
    throw Problem(
        ExitStatus::kUsage,
        fmt::format("{}: what is read and what is written would be the same file", output_path));
  }
}

void CheckNoRecording(const std::string& path, bool overwrite) {
  std::error_code unknown;
  if (overwrite || path.empty() || IsWrittenAsItIs(path)) return;
  if (fs::is_symlink(fs::symlink_status(path, unknown))) {
    throw Problem(ExitStatus::kUsage,
                  fmt::format("{}: is a symbolic link; a record is written under its own name, "
                              "never through a link. Name the file itself, or add --overwrite to "
                              "replace the link",
                              path));
  }
  if (!fs::is_regular_file(path, unknown)) return;
  if (const auto size = fs::file_size(path, unknown); unknown || size == 0) return;
  throw Problem(ExitStatus::kUsage,
                fmt::format("{}: is there already, and would be lost. Name another file, or add "
                            "--overwrite",
                            path));
}

}  // namespace levitas::session

#include "cli/run/run_folder.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "common/problem.hpp"

namespace levitas::cli {
namespace {

namespace fs = std::filesystem;
constexpr std::string_view kPrefix = "amb-run-";
constexpr std::string_view kDrawn = "XXXXXX";
constexpr const char* kLock = "run.lock";

/// A folder of a run that is over.
struct Left {
  std::string path;
  fs::file_time_type time;
  std::uintmax_t bytes{};
};

bool IsOver(const fs::path& folder) {
  struct stat facts {};
  if (::lstat(folder.c_str(), &facts) != 0 || !S_ISDIR(facts.st_mode)) return false;
  if (facts.st_uid != ::geteuid()) return false;
  const int lock = ::open((folder / kLock).c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC);
  if (lock < 0) return false;
  const bool free = ::flock(lock, LOCK_EX | LOCK_NB) == 0;
  ::close(lock);
  return free;
}

std::uintmax_t Bytes(const fs::path& folder) {
  std::error_code none;
  std::uintmax_t bytes = 0;
  for (fs::recursive_directory_iterator at(folder, none), end; at != end; at.increment(none)) {
    const std::uintmax_t size = at->is_regular_file(none) ? at->file_size(none) : 0;
    if (!none) bytes += size;
  }
  return bytes;
}

std::vector<Left> Over(const fs::path& parent) {
  std::vector<Left> all;
  std::error_code none;
  for (fs::directory_iterator at(parent, none), end; at != end; at.increment(none)) {
    const std::string name = at->path().filename().string();
    if (!name.starts_with(kPrefix) || name.size() != kPrefix.size() + kDrawn.size()) continue;
    if (!IsOver(at->path())) continue;
    all.push_back({at->path().string(), fs::last_write_time(at->path(), none), Bytes(at->path())});
  }
  std::sort(all.begin(), all.end(), [](const Left& a, const Left& b) { return a.time > b.time; });
  return all;
}

std::vector<std::string> RemoveOld(const fs::path& parent) {
  std::vector<std::string> removed;
  std::size_t count = 0;
  std::uintmax_t bytes = 0;
  for (const Left& left : Over(parent)) {
    bytes += left.bytes;
    if (++count <= RunFolder::kKept && bytes <= RunFolder::kKeptBytes) continue;
    std::error_code failed;
    fs::remove_all(left.path, failed);
    if (!failed) removed.push_back(left.path);
  }
  return removed;
}

}  // namespace

RunFolder::RunFolder() {
  const char* const told = std::getenv("TMPDIR");
  const fs::path parent = told != nullptr && *told != '\0' ? told : "/tmp";
  removed_ = RemoveOld(parent);
  std::string pattern = (parent / (std::string(kPrefix) + std::string(kDrawn))).string();
  if (mkdtemp(pattern.data()) == nullptr) {
    throw Problem(ExitStatus::kOther,
                  fmt::format("no temporary folder in {}: {}; set TMPDIR to a folder that can be "
                              "written",
                              parent.string(), std::strerror(errno)));
  }
  path_ = pattern;
  // Not closed by exec: the programs of the run hold the lock with us, and after us.
  lock_ = ::open((*this / kLock).c_str(), O_RDWR | O_CREAT | O_EXCL, 0600);
  if (lock_ >= 0) ::flock(lock_, LOCK_EX | LOCK_NB);
}

RunFolder::~RunFolder() {
  std::error_code none;
  if (!kept_) fs::remove_all(path_, none);
  if (lock_ >= 0) ::close(lock_);
}

}  // namespace levitas::cli

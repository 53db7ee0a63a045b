#include "common/output_file.hpp"

#include <fcntl.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <utility>

namespace levitas {
namespace {

constexpr mode_t kForAll = 0666;  // less what the user's umask takes away
constexpr std::size_t kBlockBytes = std::size_t{256} << 10;

bool IsDirect(const std::string& path) {
  const bool below_dev = path.starts_with("/dev/") && !path.starts_with("/dev/shm/");
  if (below_dev || path.starts_with("/proc/")) return true;
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return false;
  if (S_ISDIR(status.st_mode)) CannotWrite(path, EISDIR);
  return !S_ISREG(status.st_mode);
}

std::string Suffix() {
  std::uint64_t drawn = 0;
  if (::getrandom(&drawn, sizeof drawn, 0) != sizeof drawn)
    drawn = static_cast<unsigned>(::getpid());
  std::array<char, 32> text{};
  const int length = std::snprintf(text.data(), text.size(), ".%016llx.part",
                                   static_cast<unsigned long long>(drawn));
  return {text.data(), static_cast<std::size_t>(length)};
}

}  // namespace

void CannotWrite(const std::string& path, int error) {
  const std::string why = std::strerror(error);
  switch (error) {
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
    case EIO:
      throw Problem(ExitStatus::kOther, path + ": writing failed: " + why +
                                            ". Make room, or name a file on another disk.");
    default:
      throw BadInput(path + ": cannot be written: " + why +
                     ". Name a file in a folder that exists and is yours.");
  }
}

PartFile::PartFile(std::string path) : path_(std::move(path)) {
  if (IsDirect(path_)) {
    part_path_ = path_;
    descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, kForAll);
  } else {
    constexpr int kTries = 10;  // of 64 random bits
    for (int i = 0; i < kTries && descriptor_ < 0 && (i == 0 || errno == EEXIST); ++i) {
      part_path_ = path_ + Suffix();
      descriptor_ =
          ::open(part_path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, kForAll);
    }
  }
  if (descriptor_ < 0) CannotWrite(path_, errno);
}

PartFile::~PartFile() {
  ::close(descriptor_);
  if (!committed_ && !direct()) ::unlink(part_path_.c_str());
}

void PartFile::Commit() {
  // A pipe or a terminal has nothing to be synchronised.
  if (::fsync(descriptor_) != 0 && errno != EINVAL && errno != EROFS) {
    CannotWrite(path_, errno);
  }
  if (!direct() && std::rename(part_path_.c_str(), path_.c_str()) != 0) {
    CannotWrite(path_, errno);
  }
  committed_ = true;
}

OutputFile::OutputFile(const std::string& path) : part_(path) { buffer_.reserve(kBlockBytes); }

void OutputFile::Write(std::string_view bytes) {
  buffer_ += bytes;
  if (buffer_.size() >= kBlockBytes) Flush();
}

void OutputFile::Flush() {
  for (std::size_t done = 0; done < buffer_.size();) {
    const ssize_t wrote = ::write(part_.descriptor(), buffer_.data() + done, buffer_.size() - done);
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote <= 0) CannotWrite(part_.path(), wrote < 0 ? errno : ENOSPC);
    done += static_cast<std::size_t>(wrote);
  }
  buffer_.clear();
}

void OutputFile::Commit() {
  Flush();
  part_.Commit();
}

void WriteWholeFile(const std::string& path, std::string_view text) {
  if (path.empty()) return;
  OutputFile file(path);
  file.Write(text);
  file.Commit();
}

}  // namespace levitas

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
#include <fstream>
#include <iterator>
#include <mutex>
#include <utility>

namespace levitas {
namespace {

constexpr mode_t kForAll = 0666;  // less what the user's umask takes away
constexpr mode_t kForReaders = 0644;
constexpr std::size_t kBlockBytes = std::size_t{256} << 10;

bool IsFolder(const std::string& path) {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0 && S_ISDIR(status.st_mode);
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

[[noreturn]] void NobodyReads(const std::string& path) {
  throw BadInput(path +
                 ": cannot be written: a pipe that nobody reads. Start its reader first, or name "
                 "a file.");
}

bool IsPipe(const std::string& path) {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0 && S_ISFIFO(status.st_mode);
}

}  // namespace

bool IsWrittenAsItIs(const std::string& path) {
  const bool below_dev = path.starts_with("/dev/") && !path.starts_with("/dev/shm/");
  if (below_dev || path.starts_with("/proc/")) return true;
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return false;
  return !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode);
}

int OpenUnderItsName(const std::string& path, Standing standing) {
  if (IsWrittenAsItIs(path)) {
    const int device =
        ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NONBLOCK | O_NOCTTY,
               kForReaders);
    if (device < 0 && errno == ENXIO && IsPipe(path)) NobodyReads(path);
    if (device < 0) CannotWrite(path, errno);
    return device;
  }
  constexpr int kTries = 10;  // of whoever puts something there between the two calls
  int file = -1;
  for (int i = 0; i < kTries && file < 0; ++i) {
    const int replaced = standing == Standing::kReplaced ? ::unlink(path.c_str()) : 0;
    if (replaced != 0 && errno != ENOENT) CannotWrite(path, errno);
    file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, kForReaders);
    if (file < 0 && (errno != EEXIST || standing == Standing::kKept)) break;
  }
  if (file < 0) CannotWrite(path, errno);
  return file;
}

FileDescriptor RefuseDeafPipe(const std::string& path) {
  if (!IsPipe(path)) return FileDescriptor(-1);
  FileDescriptor pipe(::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NONBLOCK));
  if (!pipe.is_open() && errno == ENXIO) NobodyReads(path);
  return pipe;
}

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
  if (IsFolder(path_)) CannotWrite(path_, EISDIR);
  if (IsWrittenAsItIs(path_)) {
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

namespace {

struct KeptNames {
  std::mutex mutex;
  std::vector<std::string> names;
};

KeptNames& Kept() {
  static KeptNames kept;
  return kept;
}

/// Whether there is an earlier text under the name that is another one.
bool IsOtherText(const std::string& path, std::string_view text) {
  struct stat status {};
  if (IsWrittenAsItIs(path) || ::lstat(path.c_str(), &status) != 0) return false;
  if (!S_ISREG(status.st_mode) || status.st_size == 0) return false;
  if (static_cast<std::size_t>(status.st_size) != text.size()) return true;
  std::ifstream file(path, std::ios::binary);
  const std::string there{std::istreambuf_iterator<char>(file), {}};
  return there != text;
}

/// A second name of the same file first: under PATH there is always the one or the other.
void KeepEarlier(const std::string& path) {
  const std::string old = path + ".old";
  if (::unlink(old.c_str()) != 0 && errno != ENOENT) CannotWrite(old, errno);
  if (::link(path.c_str(), old.c_str()) != 0 && std::rename(path.c_str(), old.c_str()) != 0) {
    CannotWrite(old, errno);
  }
  const std::lock_guard lock(Kept().mutex);
  Kept().names.push_back(old);
}

}  // namespace

std::vector<std::string> TakeKeptNames() {
  const std::lock_guard lock(Kept().mutex);
  return std::exchange(Kept().names, {});
}

void WriteWholeFile(const std::string& path, std::string_view text, Earlier earlier) {
  if (path.empty()) return;
  OutputFile file(path);
  file.Write(text);
  file.Flush();  // a full disk shows before anything is moved
  if (earlier == Earlier::kKept && IsOtherText(path, text)) KeepEarlier(path);
  file.Commit();
}

}  // namespace levitas

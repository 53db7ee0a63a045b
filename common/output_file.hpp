#pragma once
// Files that appear under their names only when they are whole and on the disk.
//
// Written   beside the name, as PATH.<drawn at random>.part: made new, never through a symbolic
//           link, never over what is there. Commit has the kernel write it out and renames it; what
//           stood under the name until then, a symbolic link too, is replaced. Without Commit
//           it is removed.
// Direct    what exists and is no regular file (a device, a pipe), and whatever lies below /dev
//           (but for /dev/shm) or /proc, as /dev/stdout, is written as it is, and never renamed
//           over or removed.
// Failure   BadInput for a name that cannot be written; Problem of status 1 when the disk is full,
//           a quota or limit is used up, or the device fails. Both say what the kernel said.
// Thread    one per object; WriteWholeFile any.

#include <string>
#include <string_view>
#include <vector>

#include "common/file_descriptor.hpp"
#include "common/problem.hpp"

namespace levitas {

/// Throws what is to be said of a file that could not be written, from errno.
[[noreturn]] void CannotWrite(const std::string& path, int error);

/// True for what is no regular file, and below /dev and /proc: see Direct.
[[nodiscard]] bool IsWrittenAsItIs(const std::string& path);

/// What becomes of a file, or of a symbolic link, that stands under the name already.
enum class Standing { kKept, kReplaced };

/// For a file that is read while it grows, so that it cannot appear at its end only: made new under
/// its own name, never through a symbolic link. With kKept what is there is refused. Direct: as it
/// is, and neither opening nor writing ever waits: a pipe that nobody reads is BadInput, a write to
/// one that is full fails with EAGAIN. The descriptor is the caller's. Failure: as CannotWrite.
[[nodiscard]] int OpenUnderItsName(const std::string& path, Standing standing);

/// Throws BadInput for a named pipe that nobody has opened to read: to open it would wait for ever.
/// For programs that no signal ends. Keep what it returns until the pipe is written: its reader
/// takes the first close for the end.
[[nodiscard]] FileDescriptor RefuseDeafPipe(const std::string& path);

/// For writers that open a file by its name.
class PartFile {
 public:
  explicit PartFile(std::string path);
  ~PartFile();
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;

  [[nodiscard]] const std::string& path() const noexcept { return path_; }
  /// Where to write until Commit.
  [[nodiscard]] const std::string& part_path() const noexcept { return part_path_; }
  [[nodiscard]] bool direct() const noexcept { return part_path_ == path_; }
  [[nodiscard]] int descriptor() const noexcept { return descriptor_; }
  /// Call once the writing is done, and its success known.
  void Commit();

 private:
  std::string path_;
  std::string part_path_;
  int descriptor_{-1};
  bool committed_{false};
};

/// For everything else: every byte's way to the kernel is checked.
class OutputFile {
 public:
  explicit OutputFile(const std::string& path);

  void Write(std::string_view bytes);
  void Commit();
  /// Hands everything to the kernel, for who reads `part` before it is committed.
  void Flush();
  [[nodiscard]] const PartFile& part() const noexcept { return part_; }

 private:
  PartFile part_;
  std::string buffer_;
};

/// What becomes of an earlier text of other content under the name: an answer that took minutes, or
/// a file that a person has worked on, stays beside it as PATH.old, in place of one that is there.
enum class Earlier { kKept, kReplaced };

/// A whole text; an empty path means that none was asked for. What is no regular file, and what has
/// the same content, is not kept. Failure: also of PATH.old; then PATH is as it was.
void WriteWholeFile(const std::string& path, std::string_view text,
                    Earlier earlier = Earlier::kKept);

/// The names PATH.old that WriteWholeFile has made since the last call, for the program to tell.
[[nodiscard]] std::vector<std::string> TakeKeptNames();

}  // namespace levitas

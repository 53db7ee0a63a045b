#pragma once
// Looks at the name of a file about to be written before any work is done for it.
//
// Failure   BadInput when it names a folder, or its folder is missing or not writable; a usage
//           Problem when it is the file that is read, which would be lost.
// Not done  no guarantee that writing will succeed: the writer reports that.

#include <string>

namespace levitas::session {

/// `input_path` is empty when no file is read; an empty `output_path` is never wrong.
void CheckOutputPath(const std::string& output_path, const std::string& input_path);

/// A file that appears under its name only when it is complete: written beside it (".part") and
/// renamed by Commit, removed when that never comes. What exists and is no regular file (a device,
/// a pipe) is written directly and never renamed over or removed.
class PartFile {
 public:
  explicit PartFile(std::string path);
  ~PartFile();
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;

  /// Where to write until Commit.
  [[nodiscard]] const std::string& part_path() const noexcept { return part_path_; }
  /// Call once the writing is closed. Throws std::filesystem::filesystem_error.
  void Commit();

 private:
  std::string path_;
  std::string part_path_;
  bool committed_{};
};

}  // namespace levitas::session

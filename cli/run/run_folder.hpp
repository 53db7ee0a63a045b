#pragma once
// The temporary folder of one run: logs and reports of the two programs, and the record when it is
// not to be kept. Removed with its contents unless Keep was called.
//
// Rotation  of the folders that runs before have left (trips, runs that were killed) the newest
//           kKept remain, and no more than kKeptBytes in all; older ones are removed when a folder
//           is made. A folder is only touched when it has the name of one, belongs to us, holds
//           the file `run.lock`, and nobody holds that lock: the programs of a run do, also when
//           `amb run` itself is gone.
// Failure   Problem (exit status 1) when it cannot be made. What cannot be removed stays.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace levitas::cli {

class RunFolder {
 public:
  static constexpr std::size_t kKept = 10;
  static constexpr std::uintmax_t kKeptBytes = std::uintmax_t{1} << 30;

  RunFolder();
  ~RunFolder();
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;

  void Keep() noexcept { kept_ = true; }
  [[nodiscard]] const std::string& path() const noexcept { return path_; }
  [[nodiscard]] std::string operator/(const std::string& name) const { return path_ + "/" + name; }
  /// Folders of runs before that were removed.
  [[nodiscard]] const std::vector<std::string>& removed() const noexcept { return removed_; }

 private:
  std::string path_;
  std::vector<std::string> removed_;
  int lock_{-1};  ///< inherited by the programs of the run
  bool kept_{false};
};

}  // namespace levitas::cli

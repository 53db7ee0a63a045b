#pragma once
// The temporary folder of one run: logs and reports of the two programs, and the record when it is
// not to be kept. Removed with its contents unless Keep was called.
//
// Failure  Problem (exit status 1) when it cannot be made.

#include <string>

namespace levitas::cli {

class RunFolder {
 public:
  RunFolder();
  ~RunFolder();
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;

  void Keep() noexcept { kept_ = true; }
  [[nodiscard]] const std::string& path() const noexcept { return path_; }
  [[nodiscard]] std::string operator/(const std::string& name) const { return path_ + "/" + name; }

 private:
  std::string path_;
  bool kept_{false};
};

}  // namespace levitas::cli

#pragma once
// A bar, the time that has passed and what is being done, on one line of a terminal.
//
// Tick     a thread of its own draws it every half second, so that a long step is seen to live.
// Thread   Show from any one thread. Nothing is drawn when `on` is false.

#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <string>
#include <thread>

namespace levitas::cli {

class ProgressLine {
 public:
  ProgressLine(std::FILE* out, bool on);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ProgressLine(ProgressLine&&) = delete;
  ProgressLine& operator=(ProgressLine&&) = delete;

  /// The bar never goes back.
  void Show(double share, const std::string& what);
  /// Clears the line.
  void Close();

 private:
  void Draw();

  std::FILE* out_;
  std::chrono::steady_clock::time_point begin_;
  std::mutex mutex_;
  std::condition_variable closing_;
  std::string what_{"reading"};
  double share_{};
  bool on_;
  std::thread ticking_;
};

/// "[#####.....] 0:42 refitting eddy_current", as wide as any other.
[[nodiscard]] std::string ProgressText(double share, std::chrono::seconds passed,
                                       const std::string& what);

}  // namespace levitas::cli

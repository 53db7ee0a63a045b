#include "cli/study/progress_line.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace levitas::cli {

std::string ProgressText(double share, std::chrono::seconds passed, const std::string& what) {
  constexpr int kWidth = 30;
  constexpr std::size_t kLongest = 38;
  const int done = static_cast<int>(std::clamp(share, 0.0, 1.0) * kWidth);
  return fmt::format("[{:#<{}}{:.<{}}] {:>2}:{:02} {:<{}}", "", done, "", kWidth - done,
                     passed.count() / 60, passed.count() % 60, what.substr(0, kLongest), kLongest);
}

ProgressLine::ProgressLine(std::FILE* out, bool on)
    : out_(out), begin_(std::chrono::steady_clock::now()), on_(on) {
  if (!on_) return;
  ticking_ = std::thread([this] {
    std::unique_lock lock(mutex_);
    while (on_) {
      Draw();
      closing_.wait_for(lock, std::chrono::milliseconds(500));
    }
  });
}

ProgressLine::~ProgressLine() { Close(); }

void ProgressLine::Show(double share, const std::string& what) {
  const std::lock_guard lock(mutex_);
  share_ = std::max(share_, share);
  what_ = what;
  if (on_) Draw();
}

void ProgressLine::Close() {
  {
    const std::lock_guard lock(mutex_);
    if (!on_) return;
    on_ = false;
    fmt::print(out_, "\r{:79}\r", "");
    std::fflush(out_);
  }
  closing_.notify_all();
  ticking_.join();
}

void ProgressLine::Draw() {
  const auto passed =
      std::chrono::duration_cast<std::chrono::seconds>(std::chrono::steady_clock::now() - begin_);
  fmt::print(out_, "\r{}", ProgressText(share_, passed, what_));
  std::fflush(out_);
}

}  // namespace levitas::cli

#include "session/exchange/line_source.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <spawn.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "common/problem.hpp"

extern char** environ;

namespace levitas::session {

LineSource::LineSource(const std::string& path) : LineSource(path, Limits{}) {}

LineSource::LineSource(const std::string& path, const Limits& limits)
    : path_(path), limits_(limits) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) {
    throw BadInput(fmt::format("{}: cannot be read: {}", path, std::strerror(errno)));
  }
  if (S_ISDIR(status.st_mode)) {
    throw BadInput(fmt::format("{}: cannot be read: it is a folder", path));
  }
  if (path.ends_with(".xz")) {
    OpenCompressed();
  } else {
    // NOLINTNEXTLINE(cppcoreguidelines-owning-memory): this class owns it
    file_ = std::fopen(path.c_str(), "re");
  }
  if (file_ == nullptr) {
    throw BadInput(fmt::format("{}: cannot be read: {}", path, std::strerror(errno)));
  }
}

LineSource::~LineSource() {
  // NOLINTNEXTLINE(cppcoreguidelines-owning-memory): this class owns it
  if (file_ != nullptr) std::fclose(file_);
  if (child_ > 0) ::waitpid(child_, nullptr, 0);
}

void LineSource::OpenCompressed() {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) return;
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  ::posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  std::array<std::string, 4> words{"xz", "-dc", "--", path_};
  std::array<char*, 5> arguments{words[0].data(), words[1].data(), words[2].data(), words[3].data(),
                                 nullptr};
  const int failed = ::posix_spawnp(&child_, "xz", &actions, nullptr, arguments.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  ::close(ends[1]);
  if (failed != 0) {
    child_ = -1;
    ::close(ends[0]);
    throw BadInput(
        fmt::format("{}: xz cannot be started ({}). Install the package xz-utils, or "
                    "unpack the file first.",
                    path_, std::strerror(failed)));
  }
  file_ = ::fdopen(ends[0], "r");
}

void LineSource::FinishCompressed() {
  int status = 0;
  const int child = child_;
  child_ = -1;
  if (::waitpid(child, &status, 0) != child || status != 0) {
    throw BadInput(
        fmt::format("{}: not an xz file, or damaged after line {}: unpack and repair it "
                    "first",
                    path_, line_number_));
  }
}

bool LineSource::Fill() {
  constexpr std::size_t kChunkBytes = std::size_t{64} << 10;
  buffer_.erase(0, begin_);
  begin_ = 0;
  const std::size_t before = buffer_.size();
  buffer_.resize(before + kChunkBytes);
  const std::size_t got = std::fread(buffer_.data() + before, 1, kChunkBytes, file_);
  buffer_.resize(before + got);
  bytes_ += got;
  if (got == 0 && std::ferror(file_) != 0) {
    throw BadInput(fmt::format("{}: reading after line {} failed", path_, line_number_));
  }
  if (bytes_ > limits_.bytes) {
    throw BadInput(fmt::format("{}: longer than {} bytes{}; split it", path_, limits_.bytes,
                               path_.ends_with(".xz") ? " when unpacked" : ""));
  }
  return got > 0;
}

bool LineSource::Next(std::string_view& line) {
  std::size_t searched = 0;  // behind begin_
  std::size_t end = std::string::npos;
  bool more = true;
  for (;;) {
    end = buffer_.find('\n', begin_ + searched);
    searched = std::min(end, buffer_.size()) - begin_;
    if (searched > limits_.line) {
      throw BadInput(fmt::format("{}: line {} is longer than {} bytes: no rows of text", path_,
                                 line_number_ + 1, limits_.line));
    }
    if (end != std::string::npos || !more) break;
    more = Fill();
  }
  if (end == std::string::npos && searched == 0) {
    if (child_ > 0) FinishCompressed();
    return false;
  }
  line = std::string_view(buffer_).substr(begin_, searched);
  begin_ = std::min(begin_ + searched + 1, buffer_.size());
  while (line.ends_with('\r')) line.remove_suffix(1);
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (++line_number_ == 1 && line.starts_with(kByteOrderMark)) {
    line.remove_prefix(kByteOrderMark.size());
  }
  return true;
}

}  // namespace levitas::session

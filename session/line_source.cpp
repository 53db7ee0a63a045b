#include "session/line_source.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <spawn.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "common/problem.hpp"

extern char** environ;

namespace levitas::session {

LineSource::LineSource(const std::string& path) : path_(path) {
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
    // NOLINTNEXTLINE(cppcoreguidelines-owning-memory): this class owns it, as getline wants it
    file_ = std::fopen(path.c_str(), "re");
  }
  if (file_ == nullptr) {
    throw BadInput(fmt::format("{}: cannot be read: {}", path, std::strerror(errno)));
  }
}

LineSource::~LineSource() {
  // NOLINTBEGIN(cppcoreguidelines-owning-memory,cppcoreguidelines-no-malloc): getline's own storage
  if (file_ != nullptr) std::fclose(file_);
  std::free(buffer_);
  // NOLINTEND(cppcoreguidelines-owning-memory,cppcoreguidelines-no-malloc)
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

bool LineSource::Next(std::string_view& line) {
  const ssize_t length = ::getline(&buffer_, &capacity_, file_);
  if (length < 0) {
    if (std::ferror(file_) != 0) {
      throw BadInput(fmt::format("{}: reading after line {} failed", path_, line_number_));
    }
    if (child_ > 0) FinishCompressed();
    return false;
  }
  line = {buffer_, static_cast<std::size_t>(length)};
  while (line.ends_with('\n') || line.ends_with('\r')) line.remove_suffix(1);
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (++line_number_ == 1 && line.starts_with(kByteOrderMark)) {
    line.remove_prefix(kByteOrderMark.size());
  }
  return true;
}

}  // namespace levitas::session

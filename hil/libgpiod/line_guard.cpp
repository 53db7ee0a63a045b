#include "hil/libgpiod/line_guard.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <new>
#include <string_view>

#include "common/problem.hpp"

namespace levitas::gpio {

namespace {

constexpr int kPriority = 90;         // above the loop's 80: it acts when the loop has failed
constexpr int kStartAttempts = 2000;  // of a millisecond
// The line is held inactive this long, so that a rig without a pull-down has shut off meanwhile.
constexpr int kHoldMs = 500;

void Tell(std::string_view text) noexcept {
  // Never block on standard error: whoever reads it may have ended or stopped.
  pollfd room{.fd = STDERR_FILENO, .events = POLLOUT, .revents = 0};
  if (::poll(&room, 1, 0) <= 0) return;
  if (::write(STDERR_FILENO, text.data(), text.size()) < 0) return;
}

void Isolate() noexcept {
  ::setsid();
  ::prctl(PR_SET_NAME, "amb-line-guard");
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGTSTP}) {
    std::signal(signal, SIG_IGN);
  }
  // Refused without privileges: the guard then wakes as soon as the scheduler lets it.
  sched_param parameter{};
  parameter.sched_priority = kPriority;
  ::sched_setscheduler(0, SCHED_FIFO, &parameter);
  ::mlockall(MCL_CURRENT);
  const int file = ::open("/proc/self/oom_score_adj", O_WRONLY | O_CLOEXEC);
  if (file >= 0) {
    [[maybe_unused]] const ssize_t written = ::write(file, "-1000", 5);
    ::close(file);
  }
}

}  // namespace

LineGuard::LineGuard(const std::function<bool()>& make_safe, std::int64_t watchdog_ns) {
  const auto refuse = [](const char* what) {
    throw Problem(ExitStatus::kOther, std::string("no guard for the enable line: ") + what + ": " +
                                          std::strerror(errno));
  };
  void* page =
      ::mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (page == MAP_FAILED) refuse("shared memory");
  shared_ = new (page) Shared{};  // NOLINT(cppcoreguidelines-owning-memory): placement
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) refuse("pipe");
  guard_ = ::fork();
  if (guard_ < 0) refuse("process");
  if (guard_ == 0) {
    ::close(ends[1]);
    Guard(make_safe, ends[0], watchdog_ns);
  }
  ::close(ends[0]);
  pipe_end_ = ends[1];
  for (int attempt = 0; !shared_->watching.load(); ++attempt) {
    if (attempt == kStartAttempts) refuse("it does not start");
    ::poll(nullptr, 0, 1);
  }
}

LineGuard::~LineGuard() {
  shared_->dismissed.store(true);
  ::close(pipe_end_);
  ::waitpid(guard_, nullptr, 0);
  ::munmap(shared_, sizeof(Shared));
}

bool LineGuard::Arm() noexcept {
  if (shared_->acted.load()) return false;
  Beat();  // the watchdog's time starts here
  shared_->armed.store(true);
  return true;
}

void LineGuard::Disarm() noexcept { shared_->armed.store(false); }

bool LineGuard::alive() const noexcept {
  return !shared_->acted.load() && ::waitpid(guard_, nullptr, WNOHANG) == 0;
}

// Only calls that are safe after a fork: poll, read, the request's ioctl, write, _exit.
void LineGuard::Guard(const std::function<bool()>& make_safe, int pipe_end,
                      std::int64_t watchdog_ns) noexcept {
  Isolate();
  shared_->watching.store(true);
  const int look_ms = static_cast<int>(std::clamp<std::int64_t>(watchdog_ns / 4'000'000, 1, 1000));
  const std::int64_t looks = std::max<std::int64_t>(1, watchdog_ns / 1'000'000 / look_ms);
  std::uint64_t beats = 0;
  std::int64_t silent = 0;
  for (;;) {
    pollfd wait{.fd = pipe_end, .events = POLLIN, .revents = 0};
    const int ready = ::poll(&wait, 1, look_ms);
    if (ready > 0) break;  // nobody writes: the end of the pipe
    const std::uint64_t seen = shared_->beats.load();
    silent = seen == beats && shared_->armed.load() ? silent + 1 : 0;
    beats = seen;
    // Again and again: the controller may have been stopped between looking and writing.
    if (shared_->acted.load()) make_safe();
    if (silent >= looks && !shared_->acted.load()) {
      shared_->acted.store(true);
      make_safe();
      Tell("amb-line-guard: the controller's cycle stands still: enable line made inactive\n");
    }
  }
  if (shared_->dismissed.load()) ::_exit(0);
  const bool safe = make_safe();
  Tell(safe ? "amb-line-guard: the controller is gone: enable line made inactive\n"
            : "amb-line-guard: the controller is gone, and the enable line cannot be written\n");
  ::poll(nullptr, 0, kHoldMs);
  ::_exit(safe ? 0 : 1);
}

}  // namespace levitas::gpio

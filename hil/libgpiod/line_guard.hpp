#pragma once
// A process of its own that makes a line safe when this one cannot any more.
//
// Why        the kernel gives a dead process's lines back, and many chips then leave the output as
//            it was: high. The guard holds the same request, so the line is neither given back nor
//            left: it is driven inactive.
// Death      the guard reads a pipe whose other end only this process has. Killed, crashed or
//            ended without a word: the pipe ends, the guard acts, within one wake-up.
// Hang       this process counts its cycles in shared memory. No count for `watchdog_ns` while
//            armed: the guard acts, and the line stays inactive until this process ends.
// Escape     its own session, deaf to the signals of a terminal, so that ^C or a kill of the
//            process group reaches the controller alone; a name of its own, "amb-line-guard".
// Limits     whoever kills both, or stops the kernel, is left to the pull-down and to the rig's
//            heartbeat watchdog (docs/real_rig.md).
// Thread     construct before any thread is started: the guard is a fork. Arm, Disarm, Beat: one
//            thread, no system call. alive: any thread.
// Failure    Problem when the guard cannot be started.

#include <sys/types.h>

#include <atomic>
#include <cstdint>
#include <functional>

namespace levitas::gpio {

class LineGuard {
 public:
  /// Returns when the guard watches. `make_safe` runs in the guard; it must allocate nothing. True:
  /// the line is safe.
  LineGuard(const std::function<bool()>& make_safe, std::int64_t watchdog_ns);
  /// Dismisses the guard; the line must be safe already.
  ~LineGuard();
  LineGuard(const LineGuard&) = delete;
  LineGuard& operator=(const LineGuard&) = delete;

  /// The line is about to become active; false: the guard has acted, it must stay inactive.
  bool Arm() noexcept;
  void Disarm() noexcept;
  void Beat() noexcept { shared_->beats.fetch_add(1, std::memory_order_relaxed); }
  /// The guard is there and has not acted.
  [[nodiscard]] bool alive() const noexcept;
  [[nodiscard]] pid_t process() const noexcept { return guard_; }

 private:
  struct Shared {
    std::atomic<std::uint64_t> beats;
    std::atomic<bool> watching;
    std::atomic<bool> armed;
    std::atomic<bool> acted;
    std::atomic<bool> dismissed;
  };
  [[noreturn]] void Guard(const std::function<bool()>& make_safe, int pipe_end,
                          std::int64_t watchdog_ns) noexcept;

  Shared* shared_{};
  int pipe_end_{-1};
  pid_t guard_{-1};
};

}  // namespace levitas::gpio

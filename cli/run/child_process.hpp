#pragma once
// A program started beside this one, ended with it, never waited for without a bound.
//
// Life      the child is asked to end (SIGTERM) when this process dies, however that happens
//           (PR_SET_PDEATHSIG, so start it from the main thread), and by the destructor. It has a
//           process group of its own: Ctrl-C at the terminal reaches only us, and we decide what
//           the child is told.
// Life line the kernel forgets that wish where the program has file capabilities. A child with a
//           life line also holds the reading end of a pipe whose other end only this process has,
//           and is told its descriptor: the end of the pipe is the end of this process.
// Patience  a child with a life line holds a rotor: the destructor waits for its landing, and kills
//           it only when it hangs, that is, when no thread of it has run for kHung
//           (process_pulse.hpp). Any other child is killed after kPatience.
// Output    standard output and error go to one log file each child has.
// Failure   Problem (exit status 1) when the program cannot be started, naming it and why.
// Thread    the thread that started it.

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace levitas::cli {

struct ChildExit {
  bool signalled{};  ///< ended by a signal
  int code{};        ///< exit status, or the signal's number
  /// "ended with exit status 3" / "was ended by signal 9 (Killed)".
  [[nodiscard]] std::string Text() const;
};

class ChildProcess {
 public:
  static constexpr std::chrono::milliseconds kPatience{180'000};
  static constexpr std::chrono::milliseconds kHung{15'000};

  /// `arguments` without the program's name. `life_line`: the option that tells the child the
  /// descriptor of its life line; empty: it has none.
  ChildProcess(const std::string& program, const std::vector<std::string>& arguments,
               std::string log_file, const std::string& life_line = "");
  /// Ends a child that still runs, see Life, and reaps it.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// How it ended, nothing while it runs. Never blocks.
  [[nodiscard]] std::optional<ChildExit> Poll();
  /// As Poll, but waits for at most `limit`.
  [[nodiscard]] std::optional<ChildExit> WaitFor(std::chrono::milliseconds limit);
  /// Nothing happens when it has ended already.
  void Signal(int signal);
  /// Asks with SIGTERM, waits, then kills: returns when the child is gone.
  ChildExit End(std::chrono::milliseconds patience);
  /// For how long no thread of it has run, as far as calls of this function have seen.
  [[nodiscard]] std::chrono::milliseconds Silent();

  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  [[nodiscard]] pid_t pid() const noexcept { return pid_; }
  /// The end of what it wrote, at most `lines` lines.
  [[nodiscard]] std::string LastWords(std::size_t lines) const;

 private:
  std::string name_;
  std::string log_file_;
  pid_t pid_{-1};
  int life_line_{-1};  ///< our end; closed with this object
  std::uint64_t pulse_{0};
  std::chrono::steady_clock::time_point last_sign_;
  std::optional<ChildExit> exit_;
};

}  // namespace levitas::cli

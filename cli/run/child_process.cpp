#include "cli/run/child_process.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <deque>
#include <filesystem>
#include <fstream>
#include <thread>

#include "cli/run/process_pulse.hpp"
#include "common/problem.hpp"

namespace levitas::cli {
namespace {

using Clock = std::chrono::steady_clock;

/// Runs in the child between fork and exec: async-signal-safe calls only. Reports errno to `told`.
[[noreturn]] void BecomeProgram(char* const* argv, const char* log_file, pid_t parent, int told,
                                int life_line) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(127);  // the parent died before the line above
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  if (life_line >= 0) fcntl(life_line, F_SETFD, 0);  // it outlives exec
  const int input = open("/dev/null", O_RDONLY | O_CLOEXEC);
  const int log = open(log_file, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (input >= 0 && log >= 0 && dup2(input, STDIN_FILENO) >= 0 && dup2(log, STDOUT_FILENO) >= 0 &&
      dup2(log, STDERR_FILENO) >= 0) {
    execv(argv[0], argv);
  }
  const int error = errno;
  [[maybe_unused]] const ssize_t written = write(told, &error, sizeof error);
  _exit(127);
}

[[noreturn]] void Refuse(const std::string& program, const std::string& why) {
  throw Problem(ExitStatus::kOther, fmt::format("{} could not be started: {}", program, why));
}

}  // namespace

std::string ChildExit::Text() const {
  if (signalled) return fmt::format("was ended by signal {} ({})", code, strsignal(code));
  return fmt::format("ended with exit status {}", code);
}

ChildProcess::ChildProcess(const std::string& program, const std::vector<std::string>& arguments,
                           std::string log_file, const std::string& life_line)
    : name_(std::filesystem::path(program).filename()),
      log_file_(std::move(log_file)),
      last_sign_(Clock::now()) {
  std::vector<std::string> words{program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::array<int, 2> line{-1, -1};
  if (!life_line.empty()) {
    if (pipe2(line.data(), O_CLOEXEC) != 0) Refuse(program, std::strerror(errno));
    life_line_ = line[1];
    words.insert(words.end(), {life_line, std::to_string(line[0])});
  }
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  std::array<int, 2> told{};
  if (pipe2(told.data(), O_CLOEXEC) != 0) Refuse(program, std::strerror(errno));
  const pid_t parent = getpid();
  pid_ = fork();
  if (pid_ < 0) Refuse(program, std::strerror(errno));
  if (pid_ == 0) BecomeProgram(argv.data(), log_file_.c_str(), parent, told[1], line[0]);
  close(told[1]);
  if (line[0] >= 0) close(line[0]);
  // exec closes the pipe: end of file means the program runs.
  int error = 0;
  const ssize_t got = read(told[0], &error, sizeof error);
  close(told[0]);
  if (got > 0) {
    waitpid(pid_, nullptr, 0);
    Refuse(program, std::strerror(error));
  }
}

ChildProcess::~ChildProcess() {
  if (life_line_ >= 0) {
    Signal(SIGTERM);
    while (!WaitFor(std::chrono::milliseconds(500)) && Silent() < kHung) {
    }
    static_cast<void>(End(std::chrono::milliseconds(0)));
    close(life_line_);
  } else {
    static_cast<void>(End(kPatience));
  }
}

std::optional<ChildExit> ChildProcess::Poll() {
  if (exit_) return exit_;
  int status = 0;
  const pid_t ended = waitpid(pid_, &status, WNOHANG);
  if (ended != pid_) return std::nullopt;
  exit_ = WIFSIGNALED(status) ? ChildExit{true, WTERMSIG(status)}
                              : ChildExit{false, WEXITSTATUS(status)};
  return exit_;
}

std::optional<ChildExit> ChildProcess::WaitFor(std::chrono::milliseconds limit) {
  const auto deadline = Clock::now() + limit;
  while (!Poll() && Clock::now() < deadline) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return exit_;
}

void ChildProcess::Signal(int signal) {
  if (!Poll()) kill(pid_, signal);
}

std::chrono::milliseconds ChildProcess::Silent() {
  const std::optional<std::uint64_t> pulse = Poll() ? std::nullopt : PulseOf(pid_);
  const Clock::time_point now = Clock::now();
  if (!pulse || *pulse != pulse_) {  // what cannot be looked at is not known to hang
    pulse_ = pulse.value_or(0);
    last_sign_ = now;
  }
  return std::chrono::duration_cast<std::chrono::milliseconds>(now - last_sign_);
}

ChildExit ChildProcess::End(std::chrono::milliseconds patience) {
  Signal(SIGTERM);
  if (!WaitFor(patience)) {
    Signal(SIGKILL);
    // A killed process is gone at once unless the kernel itself is stuck on its behalf.
    if (!WaitFor(std::chrono::seconds(5))) return {true, SIGKILL};
  }
  return *exit_;
}

std::string ChildProcess::LastWords(std::size_t lines) const {
  std::ifstream log(log_file_);
  std::deque<std::string> kept;
  std::string line;
  while (std::getline(log, line)) {
    if (line.empty()) continue;
    kept.push_back(line);
    if (kept.size() > lines) kept.pop_front();
  }
  std::string text;
  for (const std::string& each : kept) text += (text.empty() ? "" : "\n") + each;
  return text;
}

}  // namespace levitas::cli

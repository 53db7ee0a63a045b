#include "rt/stop_signal.hpp"

#include <array>
#include <atomic>
#include <csignal>

#include "rt/clock.hpp"

namespace levitas::rt {

namespace {
std::atomic<int> asked{0};
std::atomic<bool> quit{false};
std::atomic<std::int64_t> first_interrupt_ns{0};
std::atomic<std::int64_t> first_termination_ns{0};
// Or a signal handler must not touch them.
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);
static_assert(std::atomic<std::int64_t>::is_always_lock_free);

void AskToLand() noexcept {
  int nothing = 0;
  asked.compare_exchange_strong(nothing, 1, std::memory_order_relaxed);
}

/// The same request again, and not the same delivery.
void Repeat(std::atomic<std::int64_t>& first_ns) noexcept {
  const std::int64_t now_ns = MonotonicNowNs();
  std::int64_t before_ns = 0;
  if (first_ns.compare_exchange_strong(before_ns, now_ns, std::memory_order_relaxed)) return;
  if (now_ns - before_ns >= kAgainNs) asked.store(2, std::memory_order_relaxed);
}

void Land(int signal) { NoteStopSignal(signal); }

void Quit(int /*signal*/) { quit.store(true, std::memory_order_relaxed); }

void Install(int signal, void (*handler)(int)) noexcept {
  struct sigaction action {};
  action.sa_handler = handler;
  sigfillset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  sigaction(signal, &action, nullptr);
}

bool IsIgnored(int signal) noexcept {
  struct sigaction action {};
  return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}
}  // namespace

void NoteStopSignal(int signal) noexcept {
  AskToLand();
  if (signal == SIGINT) Repeat(first_interrupt_ns);
  if (signal == SIGTERM) Repeat(first_termination_ns);
}

void ForgetStopSignals() noexcept {
  asked.store(0);
  first_interrupt_ns.store(0);
  first_termination_ns.store(0);
}

void CatchStopSignals() noexcept {
  constexpr std::array<int, 4> kLand{SIGINT, SIGTERM, SIGPWR, SIGXCPU};
  constexpr std::array<int, 12> kIgnored{SIGPIPE, SIGXFSZ,   SIGTSTP, SIGTTIN, SIGTTOU, SIGALRM,
                                         SIGIO,   SIGVTALRM, SIGPROF, SIGUSR1, SIGUSR2, SIGSTKFLT};
  for (const int signal : kLand) Install(signal, Land);
  if (!IsIgnored(SIGHUP)) Install(SIGHUP, Land);
  Install(SIGQUIT, Quit);
  for (const int signal : kIgnored) Install(signal, SIG_IGN);
  for (int signal = SIGRTMIN; signal <= SIGRTMAX; ++signal) Install(signal, SIG_IGN);
}

int StopSignals() noexcept { return asked.load(std::memory_order_relaxed); }

bool QuitSignal() noexcept { return quit.load(std::memory_order_relaxed); }

}  // namespace levitas::rt

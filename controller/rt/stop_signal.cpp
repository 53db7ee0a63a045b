#include "controller/rt/stop_signal.hpp"

#include <atomic>
#include <csignal>

namespace levitas::rt {

namespace {
std::atomic<int> asked{0};
static_assert(std::atomic<int>::is_always_lock_free);  // or a signal handler must not touch it

void Count(int /*signal*/) { asked.fetch_add(1, std::memory_order_relaxed); }
}  // namespace

void CatchStopSignals() noexcept {
  struct sigaction action {};
  action.sa_handler = Count;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  action.sa_handler = SIG_IGN;
  sigaction(SIGPIPE, &action, nullptr);
}

int StopSignals() noexcept { return asked.load(std::memory_order_relaxed); }

}  // namespace levitas::rt

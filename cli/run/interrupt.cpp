#include "cli/run/interrupt.hpp"

#include <array>
#include <atomic>
#include <csignal>

namespace levitas::cli {
namespace {

constexpr std::array<int, 3> kSignals{SIGINT, SIGTERM, SIGHUP};
std::atomic<int> caught{0};
static_assert(std::atomic<int>::is_always_lock_free);  // else not allowed in a signal handler
std::array<struct sigaction, kSignals.size()> previous{};

extern "C" void CountSignal(int /*signal*/) { caught.fetch_add(1, std::memory_order_relaxed); }

}  // namespace

InterruptGuard::InterruptGuard() {
  caught.store(0);
  struct sigaction action {};
  action.sa_handler = CountSignal;
  sigemptyset(&action.sa_mask);
  for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &action, &previous[i]);
}

InterruptGuard::~InterruptGuard() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &previous[i], nullptr);
}

int InterruptGuard::count() const noexcept { return caught.load(std::memory_order_relaxed); }

}  // namespace levitas::cli

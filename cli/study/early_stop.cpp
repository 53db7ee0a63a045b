#include "cli/study/early_stop.hpp"

#include <atomic>

namespace levitas::cli {
namespace {

std::atomic<bool> asked{false};
// Or a signal handler must not touch it.
static_assert(std::atomic<bool>::is_always_lock_free);

extern "C" void NoteEarlyStop(int /*signal*/) { asked.store(true, std::memory_order_relaxed); }

}  // namespace

EarlyStop::EarlyStop() {
  asked.store(false);
  struct sigaction action {};
  action.sa_handler = NoteEarlyStop;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART | static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, &previous_);
  // Whoever started us in the background has said that Ctrl-C is not ours.
  if (previous_.sa_handler == SIG_IGN) sigaction(SIGINT, &previous_, nullptr);
}

EarlyStop::~EarlyStop() { sigaction(SIGINT, &previous_, nullptr); }

bool EarlyStop::Asked() noexcept { return asked.load(std::memory_order_relaxed); }

}  // namespace levitas::cli

#include "cli/run/interrupt.hpp"

#include <array>
#include <chrono>
#include <csignal>
#include <thread>

#include "rt/stop_signal.hpp"

namespace levitas::cli {
namespace {

constexpr std::array<int, 3> kSignals{SIGINT, SIGTERM, SIGHUP};
std::array<struct sigaction, kSignals.size()> previous{};

extern "C" void NoteSignal(int signal) { rt::NoteStopSignal(signal); }

}  // namespace

InterruptGuard::InterruptGuard() {
  rt::ForgetStopSignals();
  struct sigaction action {};
  action.sa_handler = NoteSignal;
  sigemptyset(&action.sa_mask);
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    sigaction(kSignals[i], &action, &previous[i]);
    // Whoever started us under nohup has said what a lost connection means.
    if (previous[i].sa_handler == SIG_IGN) sigaction(kSignals[i], &previous[i], nullptr);
  }
}

// A lost connection is told several times: after the landing that the first one asked for, the next
// must not end the verdict that follows. Ctrl-C may.
InterruptGuard::~InterruptGuard() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    if (kSignals[i] == SIGHUP && rt::StopSignals() > 0) previous[i].sa_handler = SIG_IGN;
    sigaction(kSignals[i], &previous[i], nullptr);
  }
}

int InterruptGuard::count() const noexcept { return rt::StopSignals(); }

void InterruptGuard::Await() const {
  constexpr auto kLook = std::chrono::milliseconds(50);
  while (count() == 0) std::this_thread::sleep_for(kLook);
}

}  // namespace levitas::cli

#pragma once
// What signals mean to a program that holds a rotor: nothing from a terminal, a shell, a limit or a
// service manager ends it before the rotor lies. docs/safety.md has the table.
//
// Land        SIGINT, SIGTERM, SIGHUP; SIGPWR and SIGXCPU, which announce an end.
// At once     the same of SIGINT or SIGTERM again, kAgainNs or more after the first: what a
//             terminal or a launcher delivers twice is one request. A repeated SIGHUP never is: the
//             kernel, the shell and the login manager each send one when a connection is lost.
// Quit        SIGQUIT: emergency stop.
// Ignored     SIGPIPE, SIGXFSZ (the write fails instead), SIGTSTP, SIGTTIN, SIGTTOU (a stopped
//             cycle holds nothing), SIGALRM, SIGVTALRM, SIGPROF, SIGUSR1, SIGUSR2, SIGIO, SIGSTKFLT
//             and the real-time signals. SIGHUP, too, under nohup.
// Left        SIGKILL and SIGSTOP, which nobody can catch, and the crashes (SIGSEGV ...): the rig's
//             watchdog and the guard of the enable line stand behind them.
// Thread      the handlers only read a clock and store atomic numbers.

#include <cstdint>

namespace levitas::rt {

inline constexpr std::int64_t kAgainNs = 500'000'000;

/// Installs all of it; first thing in main.
void CatchStopSignals() noexcept;
/// 0: go on; 1: land; 2: end at once.
[[nodiscard]] int StopSignals() noexcept;
/// For handlers of other programs: counts SIGINT, SIGTERM and SIGHUP as above.
void NoteStopSignal(int signal) noexcept;
/// 0 again.
void ForgetStopSignals() noexcept;
/// SIGQUIT came.
[[nodiscard]] bool QuitSignal() noexcept;

}  // namespace levitas::rt

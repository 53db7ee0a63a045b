#include "rt/stop_signal.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <functional>

#include "rt/clock.hpp"

namespace levitas::rt {
namespace {

constexpr int kQuit = 8;

/// What a process that catches the signals thinks after `play`; -1 when a signal ended it.
int Asked(const std::function<void()>& play, bool hangup_ignored = false) {
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGHUP, hangup_ignored ? SIG_IGN : SIG_DFL);
    CatchStopSignals();
    play();
    _exit(StopSignals() + (QuitSignal() ? kQuit : 0));
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

void SleepPastARepetition() {
  MonotonicClock clock;
  clock.SleepUntil(clock.NowNs() + kAgainNs);
}

TEST(StopSignals, LandAtTheFirst) {
  EXPECT_EQ(Asked([] {}), 0);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPWR, SIGXCPU}) {
    EXPECT_EQ(Asked([signal] { raise(signal); }), 1) << strsignal(signal);
  }
}

TEST(StopSignals, EndAtOnceWhenTheSameComesAgainLater) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const auto twice = [signal] {
      raise(signal);
      SleepPastARepetition();
      raise(signal);
    };
    EXPECT_EQ(Asked(twice), 2) << strsignal(signal);
  }
}

// Two deliveries within a moment: a terminal and a launcher, or all of a process group.
TEST(StopSignals, TakeTwoOfAMomentForOne) {
  EXPECT_EQ(Asked([] {
              raise(SIGINT);
              raise(SIGINT);
            }),
            1);
}

TEST(StopSignals, NeverTakeALostConnectionForASecondRequest) {
  EXPECT_EQ(Asked([] {
              raise(SIGHUP);
              SleepPastARepetition();
              raise(SIGHUP);
              raise(SIGTERM);
              SleepPastARepetition();
              raise(SIGHUP);
            }),
            1);
}

TEST(StopSignals, LeaveAHangupIgnoredUnderNohup) {
  EXPECT_EQ(Asked([] { raise(SIGHUP); }, true), 0);
}

TEST(StopSignals, TakeQuitForAnEmergencyStop) {
  EXPECT_EQ(Asked([] { raise(SIGQUIT); }), kQuit);
}

TEST(StopSignals, SurviveWhatIsOfNoConcern) {
  EXPECT_EQ(
      Asked([] {
        for (const int signal : {SIGPIPE, SIGXFSZ, SIGTSTP, SIGTTIN, SIGTTOU, SIGALRM, SIGVTALRM,
                                 SIGPROF, SIGUSR1, SIGUSR2, SIGIO, SIGSTKFLT, SIGRTMIN, SIGRTMAX}) {
          raise(signal);
        }
      }),
      0);
}

}  // namespace
}  // namespace levitas::rt

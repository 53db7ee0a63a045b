#include "cli/run/process_pulse.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "tests/support/waiting.hpp"

namespace levitas::cli {
namespace {

using std::chrono::milliseconds;

/// A child that does something now and then, and one that is stopped.
pid_t Child(bool stopped) {
  const pid_t child = fork();
  if (child != 0) return child;
  if (stopped) raise(SIGSTOP);
  for (;;) test::Pause(milliseconds(2), "a life of sleeps is what is tested");
}

void End(pid_t child) {
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
}

TEST(ProcessPulse, GrowsWhileAProcessThatMostlySleepsIsAlive) {
  const pid_t child = Child(false);
  const auto first = PulseOf(child);
  ASSERT_TRUE(first.has_value());
  while (PulseOf(child) == first) std::this_thread::yield();  // for ever, were it not so
  End(child);
}

TEST(ProcessPulse, StandsStillWhileAProcessIsStopped) {
  const pid_t child = Child(true);
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, WUNTRACED), child);
  ASSERT_TRUE(WIFSTOPPED(status));
  const auto first = PulseOf(child);
  ASSERT_TRUE(first.has_value());
  // Our own pulse is the clock: a hundred of our turns, and none of its.
  const auto own = PulseOf(getpid());
  while (*PulseOf(getpid()) < *own + 100) {
    test::Pause(milliseconds(1), "our own pulse grows with each, however long it takes");
  }
  EXPECT_EQ(PulseOf(child), first);
  End(child);
}

TEST(ProcessPulse, OfAProcessThatIsGoneIsNothing) {
  const pid_t child = Child(false);
  End(child);
  EXPECT_FALSE(PulseOf(child).has_value());
}

}  // namespace
}  // namespace levitas::cli

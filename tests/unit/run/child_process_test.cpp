#include "cli/run/child_process.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "common/problem.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/waiting.hpp"

namespace levitas::cli {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;

/// Waits until the child has said the word.
bool Says(const ChildProcess& child, const std::string& word) {
  return test::Eventually([&] { return child.LastWords(1) == word; });
}

TEST(ChildProcess, TellsTheExitStatusAndTheLastWords) {
  const test::ScratchFolder scratch;
  ChildProcess child("/bin/sh", {"-c", "echo one; echo two >&2; echo three; exit 3"},
                     scratch / "log");
  const auto ended = child.WaitFor(test::kLimit);
  ASSERT_TRUE(ended);
  EXPECT_FALSE(ended->signalled);
  EXPECT_EQ(ended->code, 3);
  EXPECT_EQ(ended->Text(), "ended with exit status 3");
  EXPECT_EQ(child.LastWords(2), "two\nthree");
  EXPECT_EQ(child.name(), "sh");
}

TEST(ChildProcess, TellsWhichSignalEndedIt) {
  const test::ScratchFolder scratch;
  ChildProcess child("/bin/sh", {"-c", "kill -9 $$"}, scratch / "log");
  const auto ended = child.WaitFor(test::kLimit);
  ASSERT_TRUE(ended);
  EXPECT_EQ(ended->Text(), "was ended by signal 9 (Killed)");
}

TEST(ChildProcess, HandsArgumentsOverUnchanged) {
  const test::ScratchFolder scratch;
  ChildProcess child("/bin/echo", {"a b", "$HOME", "*"}, scratch / "log");
  ASSERT_TRUE(child.WaitFor(test::kLimit));
  EXPECT_EQ(child.LastWords(5), "a b $HOME *");
}

TEST(ChildProcess, SaysWhichProgramIsMissing) {
  const test::ScratchFolder scratch;
  try {
    ChildProcess child("/nowhere/amb-plant", {}, scratch / "log");
    FAIL() << "a program that does not exist was started";
  } catch (const Problem& problem) {
    EXPECT_STREQ(problem.what(),
                 "/nowhere/amb-plant could not be started: No such file or directory");
    EXPECT_EQ(problem.status(), ExitStatus::kOther);
  }
}

TEST(ChildProcess, DoesNotWaitForAChildThatRuns) {
  const test::ScratchFolder scratch;
  ChildProcess child("/bin/sleep", {"1000"}, scratch / "log");
  EXPECT_FALSE(child.Poll());
  EXPECT_FALSE(child.WaitFor(milliseconds(20)));
  const ChildExit ended = child.End(test::kLimit);
  EXPECT_TRUE(ended.signalled);
  EXPECT_EQ(ended.code, SIGTERM);
}

TEST(ChildProcess, KillsAChildThatIgnoresTheRequestToEnd) {
  const test::ScratchFolder scratch;
  ChildProcess child("/bin/sh", {"-c", "trap '' TERM; echo deaf; while :; do sleep 0.05; done"},
                     scratch / "log");
  ASSERT_TRUE(Says(child, "deaf"));
  const ChildExit ended = child.End(milliseconds(100));
  EXPECT_TRUE(ended.signalled);
  EXPECT_EQ(ended.code, SIGKILL);
}

TEST(ChildProcess, HasAProcessGroupOfItsOwn) {
  const test::ScratchFolder scratch;
  ChildProcess child("/bin/sleep", {"1000"}, scratch / "log");
  EXPECT_EQ(getpgid(child.pid()), child.pid());
  EXPECT_NE(getpgid(child.pid()), getpgrp());
}

TEST(ChildProcess, EndsWithTheObject) {
  const test::ScratchFolder scratch;
  pid_t pid = 0;
  {
    ChildProcess child("/bin/sleep", {"1000"}, scratch / "log");
    pid = child.pid();
  }
  EXPECT_EQ(kill(pid, 0), -1);  // reaped: no such process
}

/// True once the process is gone, or a zombie: whoever inherits it reaps it in its own time.
bool IsDead(pid_t process) {
  std::ifstream status("/proc/" + std::to_string(process) + "/stat");
  std::string pid;
  std::string name;
  std::string state;
  return !(status >> pid >> name >> state) || state == "Z";
}

/// Starts `script` as the child of a process that is then killed: nobody tidies up but the kernel.
/// Returns when the child is dead, false when it still lives after a long time.
bool DiesAfterItsParent(const test::ScratchFolder& scratch, const std::string& script,
                        const std::string& life_line = "") {
  const pid_t parent = fork();
  if (parent == 0) {
    ChildProcess child("/bin/sh", {"-c", script}, scratch / "log", life_line);
    if (!Says(child, "ready")) _exit(1);
    std::ofstream(scratch / "pid.new") << child.pid() << std::endl;
    std::filesystem::rename(scratch / "pid.new", scratch / "pid");
    pause();
    _exit(0);
  }
  EXPECT_TRUE(test::Eventually([&] { return std::filesystem::exists(scratch / "pid"); }));
  pid_t child = 0;
  std::ifstream(scratch / "pid") >> child;
  EXPECT_EQ(kill(child, 0), 0);
  kill(parent, SIGKILL);
  waitpid(parent, nullptr, 0);
  return test::Eventually([child] { return IsDead(child); });
}

TEST(ChildProcess, EndsWhenItsParentIsKilled) {
  const test::ScratchFolder scratch;
  EXPECT_TRUE(DiesAfterItsParent(scratch, "echo ready; while :; do sleep 0.02; done"));
}

TEST(ChildProcess, HasTimeToLandAfterItsParentWasKilled) {
  const test::ScratchFolder scratch;
  const std::string script = "trap 'sleep 0.3; echo landed > " + (scratch / "landed") +
                             "; exit 0' TERM; echo ready; while :; do sleep 0.02; done";
  EXPECT_TRUE(DiesAfterItsParent(scratch, script));
  EXPECT_TRUE(std::filesystem::exists(scratch / "landed"));
}

// What a file capability of the program does: the kernel forgets the wish to be told. (/bin/sh gets
// the descriptor as $1, its name for the option as $0.)
TEST(ChildProcess, WithALifeLineSeesTheEndOfItsParentWithoutASignal) {
  const test::ScratchFolder scratch;
  const std::string script =
      "trap '' TERM; echo ready; read nothing < /proc/self/fd/$1; echo landed > " +
      (scratch / "landed") + "; exit 0";
  EXPECT_TRUE(DiesAfterItsParent(scratch, script, "life-line"));
  EXPECT_TRUE(std::filesystem::exists(scratch / "landed"));
}

TEST(ChildProcess, HasTimeToLandWhenTheObjectEnds) {
  const test::ScratchFolder scratch;
  {
    ChildProcess child("/bin/sh",
                       {"-c", "trap 'sleep 0.3; echo landed > " + (scratch / "landed") +
                                  "; exit 0' TERM; echo ready; while :; do sleep 0.02; done"},
                       scratch / "log");
    ASSERT_TRUE(Says(child, "ready"));
  }
  EXPECT_TRUE(std::filesystem::exists(scratch / "landed"));
}

}  // namespace
}  // namespace levitas::cli

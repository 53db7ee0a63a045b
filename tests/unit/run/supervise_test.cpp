#include "cli/run/supervise.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <thread>

#include "common/problem.hpp"
#include "tests/support/scratch_folder.hpp"

namespace levitas::cli {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

/// Two shell scripts in place of the programs, telemetry that advances unless told otherwise.
class SuperviseTest : public testing::Test {
 protected:
  RunResult With(const std::string& controller, const std::string& plant) {
    RunPlan plan;
    plan.controller = {"/bin/sh", {"-c", controller}, scratch_ / "controller.log"};
    if (!plant.empty()) plan.plant = {"/bin/sh", {"-c", plant}, scratch_ / "plant.log"};
    plan.notice = milliseconds(300);
    plan.grace = milliseconds(300);
    plan.silence_limit = silence_limit_;
    RunHooks hooks;
    hooks.telemetry = [this](milliseconds limit) -> std::optional<ProgressSample> {
      std::this_thread::sleep_for(std::min(limit, milliseconds(5)));
      if (!telemetry_flows_) return std::nullopt;
      if (cycle_ == telemetry_fails_) throw std::length_error("a message too long");
      return ProgressSample{++cycle_, Mode::kLevitating, 0.0, {}};
    };
    hooks.progress = [](const ProgressSample&) {};
    hooks.say = [this](const std::string& text) { said_.push_back(text); };
    hooks.interrupts = [this] { return interrupts_ ? interrupts_(cycle_) : 0; };
    return Supervise(plan, hooks);
  }

  test::ScratchFolder scratch_;
  milliseconds silence_limit_{60'000};
  bool telemetry_flows_{true};
  std::uint64_t telemetry_fails_{UINT64_MAX};  ///< in this cycle
  std::uint64_t cycle_{0};
  std::function<int(std::uint64_t)> interrupts_;
  std::vector<std::string> said_;
};

TEST_F(SuperviseTest, EndsOrderlyWithTheController) {
  const RunResult result = With("exit 0", "sleep 0.05; exit 0");
  EXPECT_THAT(result.trouble, IsEmpty());
  EXPECT_EQ(result.controller.code, 0);
  EXPECT_FALSE(result.interrupted);
}

TEST_F(SuperviseTest, RunsTheControllerAloneWhereTheRigIsThereAlready) {
  const RunResult result = With("sleep 0.05; exit 4", "");
  EXPECT_THAT(result.trouble, IsEmpty());
  EXPECT_EQ(result.controller.code, 4);
  EXPECT_FALSE(result.plant.has_value());
}

TEST_F(SuperviseTest, LandsAnInterruptedRunOfTheControllerAlone) {
  interrupts_ = [](std::uint64_t cycle) { return cycle > 3 ? 1 : 0; };
  const RunResult result = With("trap 'exit 0' INT; while :; do sleep 0.02; done", "");
  EXPECT_TRUE(result.interrupted);
  EXPECT_THAT(result.trouble, IsEmpty());
  EXPECT_EQ(result.controller.code, 0);
}

TEST_F(SuperviseTest, PassesATripOnWithoutCallingItTrouble) {
  const RunResult result = With("exit 4", "exit 0");
  EXPECT_EQ(result.controller.code, 4);
  EXPECT_THAT(result.trouble, IsEmpty());
}

TEST_F(SuperviseTest, EndsARigThatDoesNotFollowItsController) {
  const RunResult result = With("exit 0", "trap '' TERM; while :; do sleep 0.02; done");
  EXPECT_THAT(result.trouble, IsEmpty());
  EXPECT_FALSE(result.plant.has_value());
}

TEST_F(SuperviseTest, SaysWhatAFailedControllerSaid) {
  const RunResult result = With("echo no memory lock >&2; exit 1", "sleep 1000");
  EXPECT_THAT(result.trouble, StartsWith("sh ended with exit status 1"));
  EXPECT_THAT(result.trouble, HasSubstr("no memory lock"));
}

TEST_F(SuperviseTest, SaysThatTheControllerWasKilled) {
  const RunResult result = With("kill -9 $$", "sleep 1000");
  EXPECT_THAT(result.trouble, StartsWith("sh was ended by signal 9 (Killed)"));
}

TEST_F(SuperviseTest, SaysThatTheRigDiedAlthoughTheControllerTripsOrderly) {
  const RunResult result = With("sleep 0.1; exit 4", "echo not finite; exit 1");
  EXPECT_EQ(result.controller.code, 4);
  EXPECT_THAT(result.trouble, StartsWith("sh ended with exit status 1"));
  EXPECT_THAT(result.trouble, HasSubstr("not finite"));
}

TEST_F(SuperviseTest, DoesNotWaitForeverForAControllerWhoseRigDied) {
  const RunResult result = With("sleep 1000", "kill -9 $$");
  EXPECT_THAT(result.trouble, StartsWith("sh was ended by signal 9 (Killed) while sh went on"));
  EXPECT_TRUE(result.controller.signalled);
}

TEST_F(SuperviseTest, EndsBothWhenNoCycleIsDoneAndSaysWhatTheyDo) {
  telemetry_flows_ = false;
  silence_limit_ = milliseconds(200);
  const RunResult result = With("sleep 1000", "kill -STOP $$; sleep 1000");
  EXPECT_THAT(result.trouble,
              StartsWith("no control cycle for 0 s: sh is sleeping, sh is stopped"));
}

TEST_F(SuperviseTest, PassesTheFirstInterruptToTheControllerOnly) {
  interrupts_ = [](std::uint64_t cycle) { return cycle > 20 ? 1 : 0; };
  const RunResult result =
      With("trap 'echo landing; exit 0' INT; while :; do sleep 0.01; done", "sleep 0.5");
  EXPECT_TRUE(result.interrupted);
  EXPECT_EQ(result.controller.code, 0);
  EXPECT_FALSE(result.controller.signalled);
  EXPECT_THAT(result.trouble, IsEmpty());
  EXPECT_EQ(said_.size(), 1U);
}

TEST_F(SuperviseTest, KillsBothOnTheSecondInterrupt) {
  interrupts_ = [](std::uint64_t cycle) { return cycle > 40 ? 2 : cycle > 20 ? 1 : 0; };
  const RunResult result = With("trap '' INT; sleep 1000", "sleep 1000");
  EXPECT_TRUE(result.controller.signalled);
  EXPECT_THAT(result.trouble, StartsWith("ended at once on request"));
}

TEST_F(SuperviseTest, ASecondInterruptLetsTheControllerSwitchOffByItself) {
  interrupts_ = [](std::uint64_t cycle) { return cycle > 40 ? 2 : cycle > 20 ? 1 : 0; };
  const RunResult result =
      With("trap 'n=x$n; test $n = x || exit 0' INT; while :; do sleep 0.01; done", "sleep 1000");
  EXPECT_FALSE(result.controller.signalled);
  EXPECT_THAT(result.trouble, StartsWith("ended at once on request"));
}

// A stranger's datagram may do that: the rotor is landed, not left to itself.
TEST_F(SuperviseTest, LandsTheRotorWhenItCanFollowTheRunNoMore) {
  telemetry_fails_ = 20;
  const RunResult result =
      With("trap 'sleep 0.5; echo landed; exit 0' INT; while :; do sleep 0.01; done", "sleep 2");
  EXPECT_FALSE(result.controller.signalled);
  EXPECT_EQ(result.controller.code, 0);
  EXPECT_THAT(result.trouble, StartsWith("the run could not be followed any further: a message"));
  EXPECT_THAT(result.trouble, HasSubstr("landed"));
}

TEST_F(SuperviseTest, NamesAProgramThatCannotBeStarted) {
  RunPlan plan;
  plan.controller = {"/nowhere/amb-controller", {}, scratch_ / "controller.log"};
  plan.plant = {"/bin/sleep", {"1000"}, scratch_ / "plant.log"};
  EXPECT_THROW(static_cast<void>(Supervise(plan, {})), Problem);
}

}  // namespace
}  // namespace levitas::cli

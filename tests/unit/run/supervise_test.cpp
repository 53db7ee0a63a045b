#include "cli/run/supervise.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <stdexcept>
#include <thread>

#include "common/problem.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/waiting.hpp"

namespace levitas::cli {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

/// Two shell scripts in place of the programs, telemetry that advances unless told otherwise.
class SuperviseTest : public testing::Test {
 protected:
  // Started in the background of a script, this program inherits an ignored SIGINT, which a shell
  // cannot trap and hands on.
  SuperviseTest() { std::signal(SIGINT, SIG_DFL); }

  RunResult With(std::string controller, const std::string& plant) {
    // Before its trap stands an interrupt would end a script like any other program.
    const std::string ready = scratch_ / "ready";
    const std::size_t trap = controller.find(" INT; ");
    const bool traps = trap != std::string::npos;
    if (traps) controller.insert(trap + 6, ": > " + ready + "; ");
    RunPlan plan;
    plan.controller = {"/bin/sh", {"-c", controller}, scratch_ / "controller.log"};
    if (!plant.empty()) plan.plant = {"/bin/sh", {"-c", plant}, scratch_ / "plant.log"};
    plan.notice = notice_;
    plan.grace = grace_;
    plan.silence_limit = silence_limit_;
    plan.hung_limit = hung_limit_;
    RunHooks hooks;
    hooks.telemetry = [=, this](milliseconds limit) -> std::optional<ProgressSample> {
      if (traps) {
        EXPECT_TRUE(test::Eventually([&] { return std::filesystem::exists(ready); }));
      }
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
  // Short where the end by force is what is tested.
  milliseconds notice_{300};
  milliseconds grace_{300};
  milliseconds silence_limit_{60'000};
  milliseconds hung_limit_{60'000};
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

// This program is stopped for longer than the limit (a suspended machine): what it has not heard
// then says nothing of the run, and what it hears next says that it goes on.
TEST_F(SuperviseTest, AStandstillOfItsOwnIsNoSilence) {
  silence_limit_ = milliseconds(200);
  interrupts_ = [](std::uint64_t cycle) {
    if (cycle == 3) std::this_thread::sleep_for(milliseconds(400));
    return 0;
  };
  const RunResult result = With("sleep 1; exit 0", "sleep 1.2; exit 0");
  EXPECT_GT(cycle_, 3U);
  EXPECT_THAT(result.trouble, IsEmpty());
  EXPECT_THAT(said_, IsEmpty());
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
  notice_ = test::kLimit;
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

// A firewall, a lost membership, memory short on the loopback: none of it says that nothing turns.
TEST_F(SuperviseTest, WithoutTelemetryAsksALivingControllerToLandAndWaitsForAsLongAsThatTakes) {
  telemetry_flows_ = false;
  silence_limit_ = milliseconds(200);
  hung_limit_ = milliseconds(5'000);
  // The landing takes many times what a hung program is given.
  const RunResult result = With(
      "n=0; trap 'n=1' INT; while :; do sleep 0.02; test $n = 0 || n=$((n + 1)); "
      "test $n -lt 100 || { echo landed; exit 0; }; done",
      "sleep 1000");
  EXPECT_FALSE(result.controller.signalled);
  EXPECT_EQ(result.controller.code, 0);
  EXPECT_THAT(result.trouble, StartsWith("no telemetry for 0 s: sh is "));
  EXPECT_THAT(result.trouble, HasSubstr("sh was asked to land the rotor, and ended with exit"));
  EXPECT_THAT(result.trouble, HasSubstr("landed"));
  ASSERT_EQ(said_.size(), 1U);
  EXPECT_THAT(said_[0], HasSubstr("landing the rotor"));
}

TEST_F(SuperviseTest, EndsAControllerOfWhichNoThreadRunsAndSaysHowThatIsKnown) {
  telemetry_flows_ = false;
  silence_limit_ = milliseconds(200);
  hung_limit_ = milliseconds(1'000);
  const RunResult result = With("exec sleep 1000", "kill -STOP $$; exec sleep 1000");
  EXPECT_TRUE(result.controller.signalled);
  EXPECT_THAT(result.trouble, StartsWith("no telemetry for 0 s: sh is "));
}

TEST_F(SuperviseTest, AControllerThatHangsInTheLandingIsEndedAndNamed) {
  telemetry_flows_ = false;
  silence_limit_ = milliseconds(200);
  hung_limit_ = milliseconds(1'000);
  const RunResult result = With("trap '' INT; exec sleep 1000", "exec sleep 1000");
  EXPECT_TRUE(result.controller.signalled);
  EXPECT_THAT(result.trouble, HasSubstr("sh hangs: no thread of it has run for 1 s"));
}

// The controller takes a second request, half a second after the first, for "at once".
TEST_F(SuperviseTest, AskedToLandInTheDarkAFirstInterruptIsNoSecondRequest) {
  telemetry_flows_ = false;
  silence_limit_ = milliseconds(200);
  int looks = 0;
  interrupts_ = [&looks](std::uint64_t) { return ++looks > 20 ? 1 : 0; };
  const RunResult result = With(
      "n=0; trap 'n=$((n + 1))' INT; i=0; while test $i -lt 150; do sleep 0.02; i=$((i + 1)); "
      "done; echo asked $n times; exit 0",
      "sleep 1000");
  EXPECT_TRUE(result.interrupted);
  EXPECT_THAT(result.trouble, HasSubstr("asked 1 times"));
}

TEST_F(SuperviseTest, PassesTheFirstInterruptToTheControllerOnly) {
  interrupts_ = [](std::uint64_t cycle) { return cycle > 20 ? 1 : 0; };
  const RunResult result =
      With("trap 'echo landing; exit 0' INT; while :; do sleep 0.01; done", "sleep 1000");
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
  grace_ = test::kLimit;
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
      With("trap 'sleep 0.5; echo landed; exit 0' INT; while :; do sleep 0.01; done", "sleep 1000");
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

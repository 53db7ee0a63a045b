// The page believes the controller's answer to its own command, and nothing else.

#include "dashboard/commander.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "common/problem.hpp"
#include "tests/support/waiting.hpp"
#include "transport/network_key.hpp"
#include "transport/operator_receiver.hpp"

namespace levitas::dashboard {
namespace {

transport::CommandAnswer AnswerTo(const CommandOrigin& origin, OperatorCommand command,
                                  bool refused = false, const std::string& text = "") {
  transport::CommandAnswer answer{.command = command, .refused = refused, .text = text};
  transport::SetSender(answer, origin);
  return answer;
}

// Far above any delay of a busy machine: a test that waits this long has failed.
constexpr std::chrono::milliseconds kLong = levitas::test::kLimit;
constexpr std::chrono::milliseconds kShort{300};

class CommanderOnTheNetwork : public testing::Test {
 protected:
  static transport::LcmNetwork Network() {
    transport::LcmNetwork network;
    network.group = "239.255.76.69";
    network.base_port = static_cast<std::uint16_t>(20'000 + 4 * (getpid() % 10'000));
    return network;
  }
  /// Not run where the network cannot be joined.
  void Make(std::chrono::milliseconds patience) {
    try {
      commander_ = std::make_unique<Commander>(Network(), patience);
    } catch (const Problem& problem) {
      GTEST_SKIP() << problem.what();
    }
  }
  std::unique_ptr<Commander> commander_;
};

TEST_F(CommanderOnTheNetwork, BelievesTheControllerOnly) {
  Make(kLong);
  if (IsSkipped()) return;
  StopLatch stops;
  const transport::OperatorReceiver controller(
      Network(), stops, {.take = [this](const transport::NetworkCommand& got) {
        const bool refused = got.command == OperatorCommand::kLand;
        commander_->Saw(AnswerTo(got.origin, got.command, refused, refused ? "not now" : ""));
        return true;
      }});
  EXPECT_EQ(commander_->Send({OperatorCommand::kLift, 0.0, 0.0}).outcome,
            CommandOutcome::kAccepted);
  const CommandReply land = commander_->Send({OperatorCommand::kLand, 0.0, 0.0});
  EXPECT_EQ(land.outcome, CommandOutcome::kRefused);
  EXPECT_EQ(land.text, "not now");
}

TEST_F(CommanderOnTheNetwork, CarriesATestSignalsTextToTheController) {
  Make(kLong);
  if (IsSkipped()) return;
  StopLatch stops;
  std::string text;
  const transport::OperatorReceiver controller(
      Network(), stops,
      {.take = [](const transport::NetworkCommand&) { return true; },
       .excite =
           [&](const transport::NetworkExcitation& request) {
             text = request.step_yaml;
             commander_->Saw(AnswerTo(request.origin, OperatorCommand::kExcite));
             return true;
           }});
  EXPECT_EQ(commander_->SendExcitation("hold_s: 1").outcome, CommandOutcome::kAccepted);
  EXPECT_EQ(text, "hold_s: 1");
}

TEST_F(CommanderOnTheNetwork, SaysSoWhenNobodyAnswers) {
  Make(kShort);
  if (IsSkipped()) return;
  const CommandReply reply = commander_->Send({OperatorCommand::kEmergencyStop, 0.0, 0.0});
  EXPECT_EQ(reply.outcome, CommandOutcome::kUnanswered);
  EXPECT_NE(reply.text.find("did not answer emergency_stop"), std::string::npos) << reply.text;
}

// The same command, the same instant: another number, or another sender's.
TEST_F(CommanderOnTheNetwork, IsNotConfirmedByTheAnswerToAnotherNumberOrSender) {
  Make(kShort);
  if (IsSkipped()) return;
  StopLatch stops;
  const transport::OperatorReceiver controller(
      Network(), stops, {.take = [this](const transport::NetworkCommand& got) {
        CommandOrigin other = got.origin;
        ++other.sequence;
        commander_->Saw(AnswerTo(other, got.command));
        other = got.origin;
        other.sender ^= 0x0100U;  // another port
        commander_->Saw(AnswerTo(other, got.command));
        return true;
      }});
  EXPECT_EQ(commander_->Send({OperatorCommand::kLift, 0.0, 0.0}).outcome,
            CommandOutcome::kUnanswered);
}

TEST_F(CommanderOnTheNetwork, GivesEachOfTwoPeopleTheAnswerToTheirOwn) {
  Make(kLong);
  if (IsSkipped()) return;
  StopLatch stops;
  std::vector<CommandOrigin> heard;
  const transport::OperatorReceiver controller(
      Network(), stops, {.take = [&](const transport::NetworkCommand& got) {
        heard.push_back(got.origin);
        if (heard.size() < 2) return true;
        // Answered in the other order: the later one is accepted.
        commander_->Saw(AnswerTo(heard[1], got.command));
        commander_->Saw(AnswerTo(heard[0], got.command, true));
        return true;
      }});
  const auto ask = [this] { return commander_->Send({OperatorCommand::kSpin, 1.0, 1.0}).outcome; };
  auto one = std::async(std::launch::async, ask);
  auto other = std::async(std::launch::async, ask);
  const auto first = one.get();
  const auto second = other.get();
  EXPECT_NE(first, second);
  EXPECT_NE(first, CommandOutcome::kUnanswered);
  EXPECT_NE(second, CommandOutcome::kUnanswered);
}

// A reset whose answer is late, then a stop: the reset is not said again after the stop.
TEST_F(CommanderOnTheNetwork, DoesNotRepeatAfterAStopWhatWasAskedBefore) {
  Make(kLong);
  if (IsSkipped()) return;
  StopLatch stops;
  std::promise<void> arrived;
  std::mutex mutex;
  std::vector<OperatorCommand> taken;
  const transport::OperatorReceiver controller(
      Network(), stops, {.take = [&](const transport::NetworkCommand& got) {
        const std::lock_guard lock(mutex);
        taken.push_back(got.command);
        if (taken.size() == 1) arrived.set_value();
        return false;  // not taken, so that a repetition would be
      }});
  auto reset = std::async(std::launch::async, [this] {
    return commander_->Send({OperatorCommand::kReset, 0.0, 0.0});
  });
  arrived.get_future().wait();
  auto stop = std::async(std::launch::async, [this] {
    return commander_->Send({OperatorCommand::kEmergencyStop, 0.0, 0.0});
  });
  const CommandReply reply = reset.get();  // long before its patience ends
  EXPECT_EQ(reply.outcome, CommandOutcome::kUnanswered);
  EXPECT_NE(reply.text.find("emergency stop"), std::string::npos) << reply.text;
  ASSERT_TRUE(levitas::test::Eventually([&] { return stops.asked() != 0; }));
  std::size_t resets = 0;
  {
    const std::lock_guard lock(mutex);
    resets = taken.size();
  }
  levitas::test::Pause(3 * Commander::kRepeat, "a repetition would come within this or longer");
  const std::lock_guard lock(mutex);
  // One may have been on its way; three more would have been sent.
  EXPECT_LE(taken.size(), resets + 1);
  CommandOrigin origin;
  ASSERT_TRUE(stops.TakeOrigin(origin));
  commander_->Saw(AnswerTo(origin, OperatorCommand::kEmergencyStop));
  EXPECT_EQ(stop.get().outcome, CommandOutcome::kAccepted);
}

// Two hundred at once, nobody answers: each datagram has left before anybody waits, and one answer
// to the last of them answers all.
TEST_F(CommanderOnTheNetwork, SendsEveryStopAtOnceAndAnswersAllWithTheLast) {
  Make(kLong);
  if (IsSkipped()) return;
  StopLatch stops;
  const transport::OperatorReceiver controller(
      Network(), stops, {.take = [](const transport::NetworkCommand&) { return true; }});
  std::atomic<int> told{0};
  for (int i = 0; i < 200; ++i) {
    commander_->Stop([&](const CommandReply& reply) {
      EXPECT_EQ(reply.outcome, CommandOutcome::kAccepted);
      told.fetch_add(1);
    });
  }
  EXPECT_EQ(told.load(), 0);
  ASSERT_TRUE(levitas::test::Eventually([&] { return stops.asked() >= 200; }));
  CommandOrigin origin;
  EXPECT_TRUE(levitas::test::Eventually([&] {  // one said again answers for all before it
    while (stops.TakeOrigin(origin)) {
    }
    commander_->Saw(AnswerTo(origin, OperatorCommand::kEmergencyStop));
    return told.load() == 200;
  }));
}

TEST_F(CommanderOnTheNetwork, TellsWhoWaitsForAStopWhenItEnds) {
  Make(kLong);
  if (IsSkipped()) return;
  std::promise<CommandReply> reply;
  commander_->Stop([&](const CommandReply& told) { reply.set_value(told); });
  commander_.reset();
  EXPECT_EQ(reply.get_future().get().outcome, CommandOutcome::kUnanswered);
}

class CommanderWithAKey : public CommanderOnTheNetwork {
 protected:
  static transport::LcmNetwork Sealed() {
    transport::LcmNetwork network = Network();
    network.key = std::make_shared<transport::NetworkKey>(transport::SealingKey::Bytes{1}, "test");
    return network;
  }
  void SetUp() override {
    try {
      commander_ = std::make_unique<Commander>(Sealed(), kLong);
    } catch (const Problem& problem) {
      GTEST_SKIP() << problem.what();
    }
  }
  /// Takes what `taken` is told of; gives its challenges to the commander when `welcomes` says so.
  transport::OperatorHandlers Handlers() {
    return {.take =
                [this](const transport::NetworkCommand& got) {
                  commander_->Saw(AnswerTo(got.origin, got.command));
                  return true;
                },
            .challenge =
                [this](const transport::Challenge& challenge) {
                  asked_by_us_ = commander_->Asked(challenge);
                  if (welcomes_) commander_->Heard(challenge);
                  welcomed_.fetch_add(1);
                }};
  }
  void Hello() {
    const int before = welcomed_.load();
    commander_->SayHello();
    ASSERT_TRUE(levitas::test::Eventually([&] { return welcomed_.load() != before; }));
  }
  bool welcomes_{true};
  std::atomic<bool> asked_by_us_{false};
  std::atomic<int> welcomed_{0};
  StopLatch stops_;
};

TEST_F(CommanderWithAKey, IsTakenOnceItHasTheChallengeOfThisControllerAndNotWithThatOfTheLast) {
  auto controller = std::make_unique<transport::OperatorReceiver>(Sealed(), stops_, Handlers());
  Hello();
  EXPECT_TRUE(asked_by_us_.load());
  EXPECT_EQ(commander_->Send({OperatorCommand::kLift, 0.0, 0.0}).outcome,
            CommandOutcome::kAccepted);
  controller = std::make_unique<transport::OperatorReceiver>(Sealed(), stops_, Handlers());
  // Said again with the old challenge it is refused; after a new hello it is taken.
  auto land = std::async(std::launch::async, [this] {
    return commander_->Send({OperatorCommand::kLand, 0.0, 0.0});
  });
  EXPECT_TRUE(levitas::test::Eventually([&] { return controller->counts().rejected > 0; }));
  Hello();
  EXPECT_EQ(land.get().outcome, CommandOutcome::kAccepted);
}

TEST_F(CommanderWithAKey, StopsWithoutAChallenge) {
  welcomes_ = false;
  const transport::OperatorReceiver controller(Sealed(), stops_, Handlers());
  std::promise<CommandReply> reply;
  commander_->Stop([&](const CommandReply& told) { reply.set_value(told); });
  ASSERT_TRUE(levitas::test::Eventually([&] { return stops_.asked() > 0; }));
  EXPECT_EQ(controller.counts().rejected, 0U);
  CommandOrigin origin;
  ASSERT_TRUE(stops_.TakeOrigin(origin));
  commander_->Saw(AnswerTo(origin, OperatorCommand::kEmergencyStop));
  EXPECT_EQ(reply.get_future().get().outcome, CommandOutcome::kAccepted);
}

}  // namespace
}  // namespace levitas::dashboard

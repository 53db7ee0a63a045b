// The page believes the controller's answer to its own command, and nothing else.

#include "dashboard/commander.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <future>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "common/problem.hpp"
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
constexpr std::chrono::milliseconds kLong{60'000};
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
  while (stops.asked() == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  std::size_t resets = 0;
  {
    const std::lock_guard lock(mutex);
    resets = taken.size();
  }
  std::this_thread::sleep_for(3 * Commander::kRepeat);
  const std::lock_guard lock(mutex);
  // One may have been on its way; three more would have been sent.
  EXPECT_LE(taken.size(), resets + 1);
  CommandOrigin origin;
  ASSERT_TRUE(stops.TakeOrigin(origin));
  commander_->Saw(AnswerTo(origin, OperatorCommand::kEmergencyStop));
  EXPECT_EQ(stop.get().outcome, CommandOutcome::kAccepted);
}

}  // namespace
}  // namespace levitas::dashboard

// What the page takes for an answer is what the controller's events say, for every command.

#include "dashboard/commander.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <memory>
#include <thread>

#include "common/problem.hpp"
#include "session/event_deriver.hpp"
#include "transport/operator_receiver.hpp"

namespace levitas::dashboard {
namespace {

/// The text of the event that the controller derives when a cycle takes the command.
std::string EventOf(OperatorCommand command, bool refused) {
  session::EventDeriver deriver({"de_x", "de_y"}, 100'000);
  cycle::CycleRecord record;
  record.in.cycle = 4711;
  record.in.frame_present = true;
  record.in.op.command = command;
  record.out.command_refused = refused;
  std::vector<session::Event> events;
  deriver.Step(record, events);
  return events.empty() ? "" : events.front().text;
}

TEST(CommandAnswer, IsFoundInTheEventOfEveryCommand) {
  for (std::uint8_t i = 1; i < kOperatorCommandCount; ++i) {
    const auto command = static_cast<OperatorCommand>(i);
    for (const bool refused : {false, true}) {
      const auto answer = AnswerIn(EventOf(command, refused));
      ASSERT_TRUE(answer) << Name(command);
      EXPECT_EQ(answer->command, command);
      EXPECT_EQ(answer->refused, refused);
    }
  }
}

TEST(CommandAnswer, IsNotSeenInOtherEvents) {
  for (const char* text : {"", "off -> lift (cycle 3)", "command", "command ", "command liftoff 3",
                           "the command lift failed"}) {
    EXPECT_FALSE(AnswerIn(text)) << text;
  }
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
  transport::OperatorReceiver controller(Network(), [this](const transport::NetworkCommand& got) {
    commander_->Saw(EventOf(got.command, got.command == OperatorCommand::kLand));
  });
  EXPECT_EQ(commander_->Send({OperatorCommand::kLift, 0.0, 0.0}).outcome,
            CommandOutcome::kAccepted);
  const CommandReply land = commander_->Send({OperatorCommand::kLand, 0.0, 0.0});
  EXPECT_EQ(land.outcome, CommandOutcome::kRefused);
  EXPECT_EQ(land.text, EventOf(OperatorCommand::kLand, true));
}

TEST_F(CommanderOnTheNetwork, CarriesATestSignalsTextToTheController) {
  Make(kLong);
  if (IsSkipped()) return;
  std::string text;
  transport::OperatorReceiver controller(
      Network(), [](const transport::NetworkCommand&) {},
      [&](const std::string& step_yaml) {
        text = step_yaml;
        commander_->Saw(EventOf(OperatorCommand::kExcite, false));
      });
  EXPECT_EQ(commander_->SendExcitation("hold_s: 1").outcome, CommandOutcome::kAccepted);
  EXPECT_EQ(text, "hold_s: 1");
}

TEST_F(CommanderOnTheNetwork, TellsWhyATestSignalWasRefused) {
  Make(kLong);
  if (IsSkipped()) return;
  transport::OperatorReceiver controller(
      Network(), [](const transport::NetworkCommand&) {},
      [&](const std::string&) { commander_->Saw("command excite refused: too many at once"); });
  const CommandReply reply = commander_->SendExcitation("hold_s: 1");
  EXPECT_EQ(reply.outcome, CommandOutcome::kRefused);
  EXPECT_NE(reply.text.find("too many"), std::string::npos);
}

TEST_F(CommanderOnTheNetwork, SaysSoWhenNobodyAnswers) {
  Make(kShort);
  if (IsSkipped()) return;
  const CommandReply reply = commander_->Send({OperatorCommand::kEmergencyStop, 0.0, 0.0});
  EXPECT_EQ(reply.outcome, CommandOutcome::kUnanswered);
  EXPECT_NE(reply.text.find("did not answer emergency_stop"), std::string::npos) << reply.text;
}

TEST_F(CommanderOnTheNetwork, IsNotConfirmedByTheAnswerToAnotherCommand) {
  Make(kShort);
  if (IsSkipped()) return;
  transport::OperatorReceiver controller(Network(), [this](const transport::NetworkCommand&) {
    commander_->Saw(EventOf(OperatorCommand::kReset, false));
  });
  EXPECT_EQ(commander_->Send({OperatorCommand::kLift, 0.0, 0.0}).outcome,
            CommandOutcome::kUnanswered);
}

}  // namespace
}  // namespace levitas::dashboard

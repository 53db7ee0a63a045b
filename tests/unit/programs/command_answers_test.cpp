#include "programs/controller/command_answers.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace levitas::controller_program {
namespace {

class Answers : public testing::Test {
 protected:
  void Given(std::uint64_t cycle, std::int64_t sequence) {
    ASSERT_TRUE(answers_.given().Post({cycle, {.sender = 1, .sequence = sequence}}));
  }
  void Saw(std::uint64_t cycle, OperatorCommand command, bool refused = false) {
    cycle::CycleRecord record;
    record.in.cycle = cycle;
    record.in.op.command = command;
    record.out.command_refused = refused;
    answers_.Saw(record);
  }
  void Heard(const char* text) {
    session::Event event;
    event.text = text;
    answers_.Heard(event);
  }
  [[nodiscard]] std::vector<std::int64_t> Sequences() const {
    std::vector<std::int64_t> sequences;
    for (const auto& answer : published_) sequences.push_back(answer.sequence);
    return sequences;
  }

  std::vector<transport::CommandAnswer> published_;
  CommandAnswers answers_{[this](const auto& answer) { published_.push_back(answer); }};
};

TEST_F(Answers, SayUnderTheCommandsOwnNumberWhatItsCycleMadeOfIt) {
  Given(7, 41);
  Heard("command lift refused in mode spinning");
  Saw(7, OperatorCommand::kLift, true);
  ASSERT_EQ(published_.size(), 1U);
  EXPECT_EQ(published_[0].sequence, 41);
  EXPECT_EQ(published_[0].command, OperatorCommand::kLift);
  EXPECT_TRUE(published_[0].refused);
  EXPECT_EQ(published_[0].cycle, 7U);
  EXPECT_EQ(published_[0].text, "command lift refused in mode spinning");
}

TEST_F(Answers, AreNotGivenToCommandsOfTheScenario) {
  Saw(3, OperatorCommand::kLift);
  EXPECT_TRUE(published_.empty());
}

TEST_F(Answers, WaitForTheRecordOfTheCommandsOwnCycle) {
  Given(9, 5);
  Saw(4, OperatorCommand::kSpin);
  Saw(9, OperatorCommand::kNone);  // no command: not the record that was meant
  EXPECT_TRUE(published_.empty());
  Saw(9, OperatorCommand::kLand);
  EXPECT_EQ(Sequences(), std::vector<std::int64_t>{5});
}

// The record of cycle 3 was lost: its command stays without an answer, the next has its own.
TEST_F(Answers, NeverGiveACommandTheOutcomeOfAnother) {
  Given(3, 1);
  Given(5, 2);
  Saw(5, OperatorCommand::kLand);
  EXPECT_EQ(Sequences(), std::vector<std::int64_t>{2});
}

TEST_F(Answers, GoToEverybodyWhoseStopOneCycleTook) {
  for (const std::int64_t sequence : {11, 12, 13}) Given(8, sequence);
  Saw(8, OperatorCommand::kEmergencyStop);
  EXPECT_EQ(Sequences(), (std::vector<std::int64_t>{11, 12, 13}));
}

TEST_F(Answers, HoldTheNewestTextAboutACommandAndNoOther) {
  Given(2, 1);
  Heard("command spin accepted");
  Heard("mode spinning");
  Saw(2, OperatorCommand::kSpin);
  ASSERT_EQ(published_.size(), 1U);
  EXPECT_EQ(published_[0].text, "command spin accepted");
}

TEST_F(Answers, OfACommandThatNoCycleWasGivenAreRefusals) {
  answers_.Refuse(OperatorCommand::kExcite, {.sender = 1, .sequence = 6}, 77, "no such channel");
  ASSERT_EQ(published_.size(), 1U);
  EXPECT_TRUE(published_[0].refused);
  EXPECT_EQ(published_[0].sequence, 6);
  EXPECT_EQ(published_[0].cycle, 77U);
  EXPECT_EQ(published_[0].text, "no such channel");
}

}  // namespace
}  // namespace levitas::controller_program

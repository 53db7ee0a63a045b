#include "transport/operator_receiver.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <levitas_msg/operator_command_t.hpp>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "tests/unit/transport/operator_receiver_fixture.hpp"

namespace levitas::transport {
namespace {

using namespace test;

TEST_F(Receiver, PassesACommandOnWithItsNumbers) {
  Send(0, 1, kSpin, 250.0);
  EXPECT_EQ(TakenBeforeTheEnd(), Commands{kSpin});
  EXPECT_EQ(taken_[0].speed_rad_per_s, 250.0);
  EXPECT_EQ(taken_[0].acceleration_rad_per_s2, 10.0);
}

TEST_F(Receiver, TakesARepeatedSequenceNumberOnce) {
  for (int time = 0; time < 5; ++time) Send(0, 1, kLift);
  Send(0, 2, kLift);  // a new number is a new command, be it the same
  EXPECT_EQ(TakenBeforeTheEnd(), (Commands{kLift, kLift}));
}

TEST_F(Receiver, KeepsTheNumbersOfTwoSendersApart) {
  Send(0, 1, kLift);
  Send(1, 1, kLand);
  EXPECT_EQ(TakenBeforeTheEnd(), (Commands{kLift, kLand}));
}

TEST_F(Receiver, IgnoresARepetitionAlsoAfterAnotherSendersCommand) {
  // A reset is said three times; another desk's command comes between.
  Send(0, 1, kReset);
  Send(1, 1, kLand);
  Send(0, 1, kReset);
  Send(0, 1, kReset);
  EXPECT_EQ(TakenBeforeTheEnd(), (Commands{kReset, kLand}));
}

TEST_F(Receiver, RefusesNumbersThatAreNotAboveTheLargestOfTheirSender) {
  Send(0, 5, kLift);
  Send(0, 6, kLand);
  Send(0, 5, kLift);  // a datagram that comes a second time, late
  Send(0, 6, kLand);
  Send(0, 4, kReset);  // overtaken on its way
  Send(0, 7, kLift);
  EXPECT_EQ(TakenBeforeTheEnd(), (Commands{kLift, kLand, kLift}));
  EXPECT_EQ(receiver_->counts().old, 2U);  // 5 and 4; the newest said again is no old one
}

TEST_F(Receiver, NotesANumberOnlyWhenItsCommandFoundRoom) {
  no_room_ = true;
  Send(0, 1, kLift);
  ASSERT_TRUE(Eventually([this] { return receiver_->counts().dropped == 1; }));
  {
    const std::lock_guard lock(mutex_);
    no_room_ = false;
  }
  Send(0, 1, kLift);  // the same, said again
  EXPECT_EQ(TakenBeforeTheEnd(), Commands{kLift});
}

// A thousand at once, where a person gives one: the other desk's command is served all the same.
TEST_F(Receiver, LeavesOthersTheirShareWhenOneSenderFloods) {
  for (std::int64_t number = 1; number <= 1000; ++number) {
    Send(0, number, kLand);
    if (number % 100 != 0) continue;  // or the kernel's own queue would overflow
    ASSERT_TRUE(Eventually([&] {
      const std::lock_guard lock(mutex_);
      return taken_.size() + receiver_->counts().dropped == static_cast<std::size_t>(number);
    }));
  }
  Send(1, 1, kLift);
  const Commands taken = TakenBeforeTheEnd();
  EXPECT_EQ(taken.back(), kLift);
  EXPECT_EQ(taken.size() - 1 + receiver_->counts().dropped, 1000U);
  // 19 s would have to pass before this many are taken.
  EXPECT_LT(taken.size(), 20U * OperatorReceiver::kMostPerSecond);
}

TEST_F(Receiver, CountsAndDropsWhatIsNoCommand) {
  Send(0, 1, OperatorCommand::kNone);
  Send(0, 2, static_cast<OperatorCommand>(kOperatorCommandCount));
  Send(0, 3, static_cast<OperatorCommand>(0x80));  // negative on the bus
  Send(0, 4, kSpin, std::nan(""));
  Send(0, 5, kSpin, INFINITY);
  const std::vector<std::uint8_t> rubbish{1, 2, 3};
  ASSERT_TRUE(sender_[0]->Send(rubbish));
  EXPECT_EQ(TakenBeforeTheEnd(), Commands{});
  EXPECT_EQ(receiver_->counts().rejected, 6U);
}

TEST_F(Receiver, RefusesToExciteWithoutASignal) {
  Send(0, 1, OperatorCommand::kExcite);
  EXPECT_EQ(TakenBeforeTheEnd(), Commands{});
  EXPECT_EQ(receiver_->counts().rejected, 1U);
}

TEST_F(Receiver, PassesTheTextOfATestSignalOnOnce) {
  std::vector<std::string> texts;
  Listen([&](const NetworkExcitation& request) {
    texts.push_back(request.step_yaml);
    return true;
  });
  SendText(1, "hold_s: 1");
  SendText(1, "hold_s: 1");  // said again
  SendText(2, "");
  EXPECT_EQ(TakenBeforeTheEnd(), Commands{});
  receiver_.reset();  // its thread has ended: the texts are ours
  EXPECT_EQ(texts, (std::vector<std::string>{"hold_s: 1", ""}));
}

TEST_F(Receiver, CountsTextsThatAreTooLongOrLieAboutTheirLength) {
  Listen([](const NetworkExcitation&) {
    ADD_FAILURE() << "passed on";
    return true;
  });
  SendText(1, std::string(kLongestExcitation, 'x'));
  for (const std::uint32_t length : {0U, 1U, 0x7fffffffU, 0xffffffffU}) SendText(2, "abc", length);
  EXPECT_EQ(TakenBeforeTheEnd(), Commands{});
  EXPECT_EQ(receiver_->counts().rejected, 5U);
}

TEST_F(Receiver, LeavesOtherChannelsOfThePortAlone) {
  Send(0, 1, kLift, 0.0, channel::kState);
  EXPECT_EQ(TakenBeforeTheEnd(), Commands{});
  EXPECT_EQ(receiver_->counts().rejected, 0U);
}

TEST_F(Receiver, DropsACommandCutAtAnyByte) {
  levitas_msg::operator_command_t message{};
  message.sequence = 1;
  message.command = static_cast<std::int8_t>(kLift);
  const std::size_t header = HeaderSize(channel::kCommand);
  const auto size = static_cast<std::size_t>(message.getEncodedSize());
  std::vector<std::uint8_t> datagram(header + size);
  WriteHeader(datagram, 0, channel::kCommand);
  message.encode(datagram.data() + header, 0, static_cast<int>(size));
  for (std::size_t length = 1; length < datagram.size(); ++length) {
    ASSERT_TRUE(sender_[0]->Send(std::span(datagram).first(length)));
  }
  EXPECT_EQ(TakenBeforeTheEnd(), Commands{});
  EXPECT_EQ(receiver_->counts().rejected, datagram.size() - 1);
}

// Two rigs may share a port number on different groups: neither hears the other.
TEST_F(Receiver, HearsOnlyItsOwnGroupOnASharedPort) {
  LcmNetwork elsewhere = Network();
  elsewhere.group = "239.255.76.69";
  MulticastReceiver other(elsewhere, Direction::kCommand);
  sender_[0] = std::make_unique<MulticastSender>(elsewhere, Direction::kCommand);
  Send(0, 1, kLift);
  EXPECT_EQ(TakenBeforeTheEnd(), Commands{});
  EXPECT_FALSE(other.Next().datagram.empty() && other.Receive(0).datagram.empty());
}

}  // namespace
}  // namespace levitas::transport

// Needs multicast on this machine; where there is no route the tests are skipped, and say so.

#include "transport/operator_receiver.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <levitas_msg/excitation_request_t.hpp>
#include <levitas_msg/operator_command_t.hpp>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "common/problem.hpp"
#include "transport/lcm_packet.hpp"

namespace levitas::transport {
namespace {

constexpr auto kLift = OperatorCommand::kLift;
constexpr auto kSpin = OperatorCommand::kSpin;
constexpr auto kLand = OperatorCommand::kLand;
constexpr auto kStop = OperatorCommand::kEmergencyStop;
constexpr auto kReset = OperatorCommand::kReset;

// A port range of its own per process, apart from those of the other multicast tests.
LcmNetwork Network() {
  LcmNetwork network;
  network.group = "239.255.76.68";
  network.base_port = static_cast<std::uint16_t>(20'000 + 4 * (getpid() % 10'000));
  return network;
}

class Receiver : public testing::Test {
 protected:
  void SetUp() override {
    try {
      receiver_ = std::make_unique<OperatorReceiver>(Network(), [this](const NetworkCommand& c) {
        const std::lock_guard lock(mutex_);
        taken_.push_back(c);
      });
      for (auto& sender : sender_) {
        sender = std::make_unique<MulticastSender>(Network(), Direction::kCommand);
      }
    } catch (const Problem& problem) {
      GTEST_SKIP() << problem.what();
    }
  }
  void TearDown() override { receiver_.reset(); }

  void Send(std::size_t from, std::int64_t sequence, OperatorCommand command,
            double speed_rad_per_s = 0.0, const char* channel = channel::kCommand) {
    levitas_msg::operator_command_t message{};
    message.sequence = sequence;
    message.command = static_cast<std::int8_t>(command);
    message.speed_rad_per_s = speed_rad_per_s;
    message.acceleration_rad_per_s2 = 10.0;
    std::vector<std::uint8_t> datagram(HeaderSize(channel) +
                                       static_cast<std::size_t>(message.getEncodedSize()));
    WriteHeader(datagram, 0, channel);
    message.encode(datagram.data() + HeaderSize(channel), 0, message.getEncodedSize());
    ASSERT_TRUE(sender_[from]->Send(datagram));
  }

  /// `length`: what the message says of the text's bytes, its zero included.
  void SendText(std::int64_t sequence, const std::string& text,
                std::optional<std::uint32_t> length = std::nullopt) {
    levitas_msg::excitation_request_t message{};
    message.sequence = sequence;
    message.step_yaml = text;
    const std::size_t header = HeaderSize(channel::kExcitation);
    std::vector<std::uint8_t> datagram(header + static_cast<std::size_t>(message.getEncodedSize()));
    WriteHeader(datagram, 0, channel::kExcitation);
    message.encode(datagram.data() + header, 0, message.getEncodedSize());
    for (std::size_t i = 0; length && i < 4; ++i) {  // behind hash and sequence
      datagram[header + 16 + i] = static_cast<std::uint8_t>(*length >> (24 - 8 * i));
    }
    ASSERT_TRUE(sender_[0]->Send(datagram));
  }

  // Everything taken before a last, unmistakable command; datagrams of one machine keep their
  // order.
  std::vector<OperatorCommand> TakenBeforeTheEnd() {
    Send(1, 1'000'000, kSpin, -777.0);
    for (int wait = 0; wait < 10'000; ++wait) {
      {
        const std::lock_guard lock(mutex_);
        if (!taken_.empty() && taken_.back().speed_rad_per_s == -777.0) {
          std::vector<OperatorCommand> commands;
          for (std::size_t i = 0; i + 1 < taken_.size(); ++i) commands.push_back(taken_[i].command);
          return commands;
        }
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    ADD_FAILURE() << "the last command did not arrive";
    return {};
  }

  std::unique_ptr<OperatorReceiver> receiver_;
  std::unique_ptr<MulticastSender> sender_[2];
  std::mutex mutex_;
  std::vector<NetworkCommand> taken_;
};

using Commands = std::vector<OperatorCommand>;

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
  // A reset is said three times; an emergency stop of another desk comes between. The repetitions
  // of the reset are older than the stop and must not undo it.
  Send(0, 1, kReset);
  Send(1, 1, kStop);
  Send(0, 1, kReset);
  Send(0, 1, kReset);
  EXPECT_EQ(TakenBeforeTheEnd(), (Commands{kReset, kStop}));
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
  EXPECT_EQ(receiver_->rejected(), 6U);
}

TEST_F(Receiver, RefusesToExciteWithoutASignal) {
  Send(0, 1, OperatorCommand::kExcite);
  EXPECT_EQ(TakenBeforeTheEnd(), Commands{});
  EXPECT_EQ(receiver_->rejected(), 1U);
}

TEST_F(Receiver, PassesTheTextOfATestSignalOnOnce) {
  std::vector<std::string> texts;
  receiver_.reset();
  receiver_ = std::make_unique<OperatorReceiver>(
      Network(),
      [this](const NetworkCommand& c) {
        const std::lock_guard lock(mutex_);
        taken_.push_back(c);
      },
      [&](const std::string& text) { texts.push_back(text); });
  SendText(1, "hold_s: 1");
  SendText(1, "hold_s: 1");  // said again
  SendText(2, "");
  EXPECT_EQ(TakenBeforeTheEnd(), Commands{});
  receiver_.reset();  // its thread has ended: the texts are ours
  EXPECT_EQ(texts, (std::vector<std::string>{"hold_s: 1", ""}));
}

TEST_F(Receiver, CountsTextsThatAreTooLongOrLieAboutTheirLength) {
  receiver_.reset();
  receiver_ = std::make_unique<OperatorReceiver>(
      Network(),
      [this](const NetworkCommand& c) {
        const std::lock_guard lock(mutex_);
        taken_.push_back(c);
      },
      [](const std::string&) { ADD_FAILURE() << "passed on"; });
  SendText(1, std::string(OperatorReceiver::kLongestText, 'x'));
  for (const std::uint32_t length : {0U, 1U, 0x7fffffffU, 0xffffffffU}) SendText(2, "abc", length);
  EXPECT_EQ(TakenBeforeTheEnd(), Commands{});
  EXPECT_EQ(receiver_->rejected(), 5U);
}

TEST_F(Receiver, LeavesOtherChannelsOfThePortAlone) {
  Send(0, 1, kLift, 0.0, channel::kState);
  EXPECT_EQ(TakenBeforeTheEnd(), Commands{});
  EXPECT_EQ(receiver_->rejected(), 0U);
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
  EXPECT_EQ(receiver_->rejected(), datagram.size() - 1);
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

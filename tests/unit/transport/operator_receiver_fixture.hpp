#pragma once
// An OperatorReceiver on the network, two senders, and a commands' thread that can be held up.
// Needs multicast on this machine; where there is no route the tests are skipped, and say so.

#include <gtest/gtest.h>
#include <unistd.h>

#include <condition_variable>
#include <functional>
#include <levitas_msg/excitation_request_t.hpp>
#include <levitas_msg/operator_command_t.hpp>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "common/problem.hpp"
#include "tests/support/waiting.hpp"
#include "transport/lcm_packet.hpp"
#include "transport/operator_receiver.hpp"

namespace levitas::transport::test {

using levitas::test::Eventually;

inline constexpr auto kLift = OperatorCommand::kLift;
inline constexpr auto kSpin = OperatorCommand::kSpin;
inline constexpr auto kLand = OperatorCommand::kLand;
inline constexpr auto kStop = OperatorCommand::kEmergencyStop;
inline constexpr auto kReset = OperatorCommand::kReset;

// A port range of its own per process, apart from those of the other multicast tests.
inline LcmNetwork Network() {
  LcmNetwork network;
  network.group = "239.255.76.68";
  network.base_port = static_cast<std::uint16_t>(20'000 + 4 * (getpid() % 10'000));
  return network;
}

class Receiver : public testing::Test {
 protected:
  void SetUp() override {
    try {
      Listen();
      for (auto& sender : sender_) {
        sender = std::make_unique<MulticastSender>(Network(), Direction::kCommand);
      }
    } catch (const Problem& problem) {
      GTEST_SKIP() << problem.what();
    }
  }
  void Listen(std::function<bool(const NetworkExcitation&)> excite = {}) {
    receiver_.reset();
    receiver_ = std::make_unique<OperatorReceiver>(
        Network(), stops_,
        OperatorHandlers{.take = [this](const NetworkCommand& c) { return Take(c); },
                         .excite = std::move(excite)});
  }
  bool Take(const NetworkCommand& command) {
    std::unique_lock lock(mutex_);
    ++entered_;
    changed_.wait(lock, [this] { return !held_up_; });
    if (no_room_ && command.speed_rad_per_s != kEnd) return false;
    taken_.push_back(command);
    return true;
  }
  /// The thread that takes commands comes no further from now on, or goes on.
  void HoldUp(bool held_up) {
    {
      const std::lock_guard lock(mutex_);
      held_up_ = held_up;
    }
    changed_.notify_all();
  }
  void TearDown() override {
    HoldUp(false);
    receiver_.reset();
  }

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

  /// A message that ends one byte early.
  void SendCut(OperatorCommand command) {
    levitas_msg::operator_command_t message{};
    message.command = static_cast<std::int8_t>(command);
    const std::size_t header = HeaderSize(channel::kCommand);
    std::vector<std::uint8_t> datagram(header + static_cast<std::size_t>(message.getEncodedSize()));
    WriteHeader(datagram, 0, channel::kCommand);
    message.encode(datagram.data() + header, 0, message.getEncodedSize());
    datagram.pop_back();
    ASSERT_TRUE(sender_[0]->Send(datagram));
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
  // order. It is said again while a stop that is not passed yet keeps it back.
  std::vector<OperatorCommand> TakenBeforeTheEnd() {
    int wait = 0;
    std::vector<OperatorCommand> commands;
    EXPECT_TRUE(Eventually([&] {
      if (wait++ % 100 == 0) Send(1, 1'000'000, kSpin, kEnd);
      const std::lock_guard lock(mutex_);
      if (taken_.empty() || taken_.back().speed_rad_per_s != kEnd) return false;
      for (std::size_t i = 0; i + 1 < taken_.size(); ++i) commands.push_back(taken_[i].command);
      return true;
    })) << "the last command did not arrive";
    return commands;
  }

  static constexpr double kEnd = -777.0;
  StopLatch stops_;
  std::unique_ptr<OperatorReceiver> receiver_;
  std::unique_ptr<MulticastSender> sender_[2];
  std::mutex mutex_;
  std::condition_variable changed_;
  int entered_{0};  ///< calls of Take, finished or not
  bool held_up_{false};
  bool no_room_{false};
  std::vector<NetworkCommand> taken_;
};

using Commands = std::vector<OperatorCommand>;

}  // namespace levitas::transport::test

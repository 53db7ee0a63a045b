// Needs multicast on this machine; where there is no route the tests are skipped, and say so (the
// process tests bring a network of their own).

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <memory>

#include "common/problem.hpp"
#include "rt/clock.hpp"
#include "tests/support/allocation_guard.hpp"
#include "transport/lcm_packet.hpp"
#include "transport/lcm_rig_link.hpp"
#include "transport/lcm_rig_port.hpp"
#include "transport/network_key.hpp"

namespace levitas::transport {
namespace {

constexpr std::int64_t kLong = 5'000'000'000;  // [ns] more than a loaded machine needs

// A port range of its own per process, so that parallel tests do not hear each other.
LcmNetwork Network() {
  LcmNetwork network;
  network.base_port = static_cast<std::uint16_t>(20'000 + 4 * (getpid() % 10'000));
  return network;
}

class Multicast : public testing::Test {
 protected:
  void SetUp() override {
    try {
      link_ = std::make_unique<LcmRigLink>(Network(), 4, 0);
      port_ = std::make_unique<LcmRigPort>(Network(), 4, 0);
    } catch (const Problem& problem) {
      GTEST_SKIP() << problem.what();
    }
  }
  static std::int64_t Deadline() { return rt::MonotonicNowNs() + kLong; }

  std::unique_ptr<LcmRigLink> link_;
  std::unique_ptr<LcmRigPort> port_;
};

SensorFrame Frame(std::uint64_t cycle, std::uint32_t session = 7) {
  SensorFrame frame;
  frame.cycle = cycle;
  frame.rig_session = session;
  return frame;
}

TEST_F(Multicast, CarriesAFrameThereAndItsAnswerBack) {
  ASSERT_TRUE(link_->Send(Frame(3)));
  SensorFrame frame;
  ASSERT_EQ(port_->Read(frame, Deadline()), port::ReadResult::kFrame);
  EXPECT_EQ(frame.cycle, 3U);
  ASSERT_TRUE(port_->Write({.cycle = 3}));
  CurrentFrame current;
  ASSERT_EQ(link_->Receive(current, Deadline()), LcmRigLink::ReceiveResult::kCurrent);
  EXPECT_EQ(current.cycle, 3U);
}

TEST_F(Multicast, ReadsTheNewestFrameAndCountsTheOvertakenOnes) {
  SensorFrame frame;
  ASSERT_TRUE(link_->Send(Frame(0)));
  ASSERT_EQ(port_->Read(frame, Deadline()), port::ReadResult::kFrame);
  for (std::uint64_t cycle = 1; cycle <= 20; ++cycle) ASSERT_TRUE(link_->Send(Frame(cycle)));
  ASSERT_EQ(port_->Read(frame, Deadline()), port::ReadResult::kFrame);
  EXPECT_EQ(frame.cycle, 20U);
  EXPECT_EQ(port_->counters().frames_skipped, 19U);
  EXPECT_EQ(port_->counters().frames_lost, 0U);
}

// Of what is queued: the last to arrive is not always the newest.
TEST_F(Multicast, ReadsTheNewestCurrentsWhereOneOvertakesAnother) {
  for (const std::uint64_t cycle : {5U, 7U, 6U}) ASSERT_TRUE(port_->Write({.cycle = cycle}));
  CurrentFrame current;
  ASSERT_EQ(link_->Receive(current, Deadline()), LcmRigLink::ReceiveResult::kCurrent);
  EXPECT_EQ(current.cycle, 7U);
  EXPECT_EQ(link_->counters().currents_skipped, 2U);
}

TEST_F(Multicast, NumbersTheRigsSessionsFromOneWhateverTheRigDraws) {
  SensorFrame frame;
  std::array<std::uint32_t, 4> seen{};
  const std::array<std::uint32_t, 4> drawn{0xDEADBEEF, 0xDEADBEEF, 5, 0xDEADBEEF};
  for (std::size_t at = 0; at < drawn.size(); ++at) {
    ASSERT_TRUE(link_->Send(Frame(at, drawn[at])));
    ASSERT_EQ(port_->Read(frame, Deadline()), port::ReadResult::kFrame);
    seen[at] = frame.rig_session;
  }
  EXPECT_EQ(seen, (std::array<std::uint32_t, 4>{1, 1, 2, 3}));
}

TEST_F(Multicast, ReadsNothingAtADeadlineInThePast) {
  SensorFrame frame;
  EXPECT_EQ(port_->Read(frame, 0), port::ReadResult::kNothing);
}

TEST_F(Multicast, SkipsRubbishAndEmptyDatagramsOnTheWayToAFrame) {
  MulticastSender rubbish(Network(), Direction::kSensor);
  SensorFrameCodec two(2);
  const std::array<std::uint8_t, 5> noise{1, 2, 3, 4, 5};
  ASSERT_TRUE(rubbish.Send(noise));
  ASSERT_TRUE(rubbish.Send({}));
  ASSERT_TRUE(rubbish.Send(two.Encode({})));
  ASSERT_TRUE(link_->Send(Frame(9)));
  SensorFrame frame;
  ASSERT_EQ(port_->Read(frame, Deadline()), port::ReadResult::kFrame);
  EXPECT_EQ(frame.cycle, 9U);
  EXPECT_EQ(port_->counters().frames_rejected, 2U);  // the noise and the other rig's frame
}

TEST_F(Multicast, TakesTheFramesOfOneRigAndRefusesCountsAndNamesThoseOfASecond) {
  LcmRigLink second(Network(), 4, 0);
  SensorFrame frame;
  ASSERT_TRUE(link_->Send(Frame(1)));
  ASSERT_TRUE(second.Send(Frame(100, 8)));
  ASSERT_TRUE(second.Send(Frame(101, 8)));
  ASSERT_EQ(port_->Read(frame, Deadline()), port::ReadResult::kFrame);
  EXPECT_EQ(frame.cycle, 1U);
  EXPECT_EQ(port_->counters().frames_refused, 2U);
  EXPECT_THAT(port_->TakeNews(), testing::IsEmpty());  // the first one may have ended
  ASSERT_TRUE(link_->Send(Frame(2)));
  ASSERT_EQ(port_->Read(frame, Deadline()), port::ReadResult::kFrame);
  EXPECT_EQ(frame.rig_session, 1U);
  EXPECT_THAT(port_->TakeNews(), testing::HasSubstr("frames of a second rig at 127.0.0.1:"));
  EXPECT_THAT(port_->TakeNews(), testing::IsEmpty());  // said once
  EXPECT_THAT(port_->Trouble(), testing::HasSubstr("2 frames of a second rig were refused"));
}

TEST_F(Multicast, ObeysOneControllerAndRefusesTheCurrentsAndTheGoodbyeOfASecond) {
  LcmRigPort second(Network(), 4, 0);
  CurrentFrame current;
  ASSERT_TRUE(port_->Write({.cycle = 1}));
  ASSERT_TRUE(second.Write({.cycle = 100}));
  second.SayGoodbye({.cycle = 100});
  ASSERT_TRUE(port_->Write({.cycle = 2}));
  ASSERT_EQ(link_->Receive(current, Deadline()), LcmRigLink::ReceiveResult::kCurrent);
  EXPECT_EQ(current.cycle, 2U);
  EXPECT_EQ(link_->counters().currents_refused, 4U);
  EXPECT_THAT(link_->TakeNews(), testing::HasSubstr("second controller at 127.0.0.1:"));
}

TEST_F(Multicast, TakesTheNextControllerAtOnceAfterAGoodbye) {
  CurrentFrame current;
  ASSERT_TRUE(port_->Write({.cycle = 1}));
  port_->SayGoodbye({.cycle = 1});
  ASSERT_EQ(link_->Receive(current, Deadline()), LcmRigLink::ReceiveResult::kGoodbye);
  LcmRigPort next(Network(), 4, 0);
  ASSERT_TRUE(next.Write({.cycle = 7}));
  while (link_->Receive(current, Deadline()) == LcmRigLink::ReceiveResult::kGoodbye) {
    // said three times
  }
  EXPECT_EQ(current.cycle, 7U);
  EXPECT_EQ(link_->counters().currents_refused, 0U);
}

TEST_F(Multicast, AFloodOfRubbishDoesNotHoldAReadBeyondItsDeadline) {
  MulticastSender flood(Network(), Direction::kSensor);
  const std::array<std::uint8_t, 5> noise{1, 2, 3, 4, 5};
  for (int count = 0; count < 300; ++count) ASSERT_TRUE(flood.Send(noise));
  SensorFrame frame;
  EXPECT_EQ(port_->Read(frame, 0), port::ReadResult::kNothing);
  EXPECT_LE(port_->counters().frames_rejected, 64U);  // ReadBound::kUselessLate
}

TEST_F(Multicast, HearsTheGoodbyeAfterTheLastCurrent) {
  ASSERT_TRUE(port_->Write({.cycle = 1}));
  port_->SayGoodbye({.cycle = 1});
  CurrentFrame current;
  EXPECT_EQ(link_->Receive(current, Deadline()), LcmRigLink::ReceiveResult::kGoodbye);
}

TEST_F(Multicast, AllocatesNothingIn10000Exchanges) {
  SensorFrame frame = Frame(0);
  CurrentFrame current;
  const test::AllocationGuard guard;
  for (int count = 0; count < 10'000; ++count) {
    (void)link_->Send(frame);
    (void)port_->Read(frame, rt::MonotonicNowNs() + kLong);
    (void)port_->Write(current);
    (void)link_->Receive(current, rt::MonotonicNowNs() + kLong);
  }
  EXPECT_EQ(guard.count(), 0U);
  EXPECT_EQ(port_->counters().frames_read, 10'000U);
}

// An address can be forged; who does so has another seal all the same. Without a key there is
// nothing but the address.
TEST_F(Multicast, KnowsASenderByItsSealAndWithoutAKeyByItsAddress) {
  LcmNetwork sealed = Network();
  sealed.group = "239.255.76.70";
  sealed.key = std::make_shared<NetworkKey>(SealingKey::Bytes{1}, "test");
  const std::array<std::uint8_t, 3> word{1, 2, 3};
  MulticastReceiver receiver(sealed, Direction::kSensor);
  MulticastSender one(sealed, Direction::kSensor);
  MulticastSender other(sealed, Direction::kSensor);
  for (MulticastSender* sender : {&one, &other}) {
    ASSERT_TRUE(sender->Send(word));
    const Received received = receiver.Receive(Deadline());
    EXPECT_EQ(received.datagram.size(), word.size());
    EXPECT_EQ(received.identity, sender->identity());
    EXPECT_TRUE(received.proven);
  }
  EXPECT_NE(one.identity(), other.identity());

  MulticastReceiver open(Network(), Direction::kTelemetry);
  MulticastSender plain(Network(), Direction::kTelemetry);
  ASSERT_TRUE(plain.Send(word));
  const Received received = open.Receive(Deadline());
  EXPECT_EQ(received.identity, received.sender);
  EXPECT_EQ(plain.identity(), 0U);
}

}  // namespace
}  // namespace levitas::transport

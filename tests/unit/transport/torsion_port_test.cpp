// Measured torsion from the rig's end of the network to the controller's, beside the frames. Needs
// multicast on this machine, as multicast_test.cpp does.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>
#include <vector>

#include "common/problem.hpp"
#include "common/random.hpp"
#include "rt/clock.hpp"
#include "tests/support/allocation_guard.hpp"
#include "transport/lcm_packet.hpp"
#include "transport/lcm_rig_link.hpp"
#include "transport/lcm_rig_port.hpp"

namespace levitas::transport {
namespace {

constexpr std::uint32_t kDrawn = 0xDEADBEEF;  // what the rig drew as its session

TorsionBatch DrawnBatch(std::uint64_t first_cycle, std::uint32_t session = kDrawn) {
  Random draw{first_cycle + 1};
  TorsionBatch batch{
      .first_cycle = first_cycle, .rig_session = session, .couplings = 2, .samples = 32};
  for (std::size_t i = 0; i < 64; ++i) {
    batch.torque_n_m[i] = draw.Normal();
    batch.twist_rad[i] = 1e-4 * draw.Normal();
  }
  return batch;
}

/// All but the session, bit for bit.
bool SameReadings(const TorsionBatch& a, const TorsionBatch& b) {
  const auto same = [](double one, double other) {
    return std::bit_cast<std::uint64_t>(one) == std::bit_cast<std::uint64_t>(other);
  };
  return a.first_cycle == b.first_cycle && a.couplings == b.couplings && a.samples == b.samples &&
         std::ranges::equal(a.torque_n_m, b.torque_n_m, same) &&
         std::ranges::equal(a.twist_rad, b.twist_rad, same);
}

SensorFrame FrameOf(std::uint64_t cycle, std::uint32_t session = kDrawn) {
  SensorFrame frame;
  frame.cycle = cycle;
  frame.rig_session = session;
  return frame;
}

class TorsionPort : public testing::Test {
 protected:
  void SetUp() override {
    try {
      link_ = std::make_unique<LcmRigLink>(Ports(), 4, 0);
      port_ = std::make_unique<LcmRigPort>(Ports(), 4, 0);
    } catch (const Problem& problem) {
      GTEST_SKIP() << problem.what();
    }
  }
  // A port range of its own per process, so that parallel tests do not hear each other.
  static LcmNetwork Ports() {
    LcmNetwork network;
    network.base_port = static_cast<std::uint16_t>(20'000 + 4 * (getpid() % 10'000));
    return network;
  }
  /// A frame there and read; what was sent before it is then at the port too.
  void Exchange(std::uint64_t cycle, std::uint32_t session = kDrawn) {
    ASSERT_TRUE(link_->Send(FrameOf(cycle, session)));
    SensorFrame frame;
    ASSERT_EQ(port_->Read(frame, rt::MonotonicNowNs() + 5'000'000'000), port::ReadResult::kFrame);
    ASSERT_EQ(frame.cycle, cycle);
  }
  /// First cycles of all that the port has.
  std::vector<std::uint64_t> TakeAll() {
    std::vector<std::uint64_t> first;
    TorsionBatch batch;
    while (port_->TakeTorsion(batch)) first.push_back(batch.first_cycle);
    return first;
  }

  std::unique_ptr<LcmRigLink> link_;
  std::unique_ptr<LcmRigPort> port_;
};

TEST_F(TorsionPort, GivesABatchOnceWithThePortsOwnCountOfTheSession) {
  Exchange(0);
  TorsionBatch taken;
  EXPECT_FALSE(port_->TakeTorsion(taken));
  ASSERT_TRUE(link_->SendTorsion(DrawnBatch(1)));
  Exchange(33);
  ASSERT_TRUE(port_->TakeTorsion(taken));
  EXPECT_TRUE(SameReadings(taken, DrawnBatch(1)));
  EXPECT_EQ(taken.rig_session, 1U);
  EXPECT_FALSE(port_->TakeTorsion(taken));
  Exchange(0, 5);  // the rig starts again
  ASSERT_TRUE(link_->SendTorsion(DrawnBatch(1, 5)));
  Exchange(33, 5);
  ASSERT_TRUE(port_->TakeTorsion(taken));
  EXPECT_EQ(taken.rig_session, 2U);
}

TEST_F(TorsionPort, TakesNoBatchBeforeAFrameOfItsRigSession) {
  ASSERT_TRUE(link_->SendTorsion(DrawnBatch(1)));
  Exchange(33);
  ASSERT_TRUE(link_->SendTorsion(DrawnBatch(1, 5)));
  Exchange(33, 5);
  ASSERT_TRUE(link_->SendTorsion(DrawnBatch(65)));  // of the session that has ended
  Exchange(65, 5);
  EXPECT_THAT(TakeAll(), testing::IsEmpty());
}

TEST_F(TorsionPort, KeepsTheNewestEightWhereNobodyTakesThem) {
  Exchange(0);
  for (std::uint64_t at = 1; at <= 11; ++at) ASSERT_TRUE(link_->SendTorsion(DrawnBatch(at)));
  Exchange(1);
  EXPECT_THAT(TakeAll(), testing::ElementsAre(4, 5, 6, 7, 8, 9, 10, 11));
  for (std::uint64_t at = 12; at <= 14; ++at) ASSERT_TRUE(link_->SendTorsion(DrawnBatch(at)));
  Exchange(2);
  EXPECT_THAT(TakeAll(), testing::ElementsAre(12, 13, 14));
}

TEST_F(TorsionPort, ARefusedBatchTakesThePlaceOfNoneThatIsKept) {
  Exchange(0);
  for (std::uint64_t at = 1; at <= 8; ++at) ASSERT_TRUE(link_->SendTorsion(DrawnBatch(at)));
  ASSERT_TRUE(link_->SendTorsion(DrawnBatch(99, 5)));
  Exchange(1);
  TorsionBatch oldest;
  ASSERT_TRUE(port_->TakeTorsion(oldest));
  EXPECT_TRUE(SameReadings(oldest, DrawnBatch(1)));
  EXPECT_EQ(oldest.rig_session, 1U);
  EXPECT_THAT(TakeAll(), testing::ElementsAre(2, 3, 4, 5, 6, 7, 8));
}

TEST_F(TorsionPort, TakesNoBatchOfAnotherSenderThanThatOfTheFrames) {
  LcmRigLink second(Ports(), 4, 0);
  Exchange(0);
  ASSERT_TRUE(second.SendTorsion(DrawnBatch(1)));  // even with the session of the first
  ASSERT_TRUE(link_->SendTorsion(DrawnBatch(2)));
  Exchange(33);
  EXPECT_THAT(TakeAll(), testing::ElementsAre(2));
}

TEST_F(TorsionPort, ADamagedBatchIsNotTakenAndCostsNoFrame) {
  MulticastSender rig(Ports(), Direction::kSensor);
  SensorFrameCodec frames(4);
  TorsionPacket packet;
  ASSERT_TRUE(rig.Send(frames.Encode(FrameOf(0))));
  SensorFrame frame;
  const std::int64_t deadline_ns = rt::MonotonicNowNs() + 5'000'000'000;
  ASSERT_EQ(port_->Read(frame, deadline_ns), port::ReadResult::kFrame);
  const auto sound = packet.Encode(DrawnBatch(1));
  std::vector<std::uint8_t> damaged(sound.begin(), sound.end());
  damaged[damaged.size() / 2] ^= 1U;
  ASSERT_TRUE(rig.Send(damaged));
  ASSERT_TRUE(rig.Send(packet.Encode(DrawnBatch(2))));
  ASSERT_TRUE(rig.Send(frames.Encode(FrameOf(33))));
  ASSERT_EQ(port_->Read(frame, deadline_ns), port::ReadResult::kFrame);
  EXPECT_EQ(frame.cycle, 33U);
  EXPECT_EQ(port_->counters().frames_rejected, 0U);
  EXPECT_THAT(TakeAll(), testing::ElementsAre(2));
}

TEST_F(TorsionPort, AllocatesNothingIn300Batches) {
  const TorsionBatch batch = DrawnBatch(1);
  Exchange(0);
  std::uint64_t taken = 0;
  SensorFrame frame;
  TorsionBatch into;
  const levitas::test::AllocationGuard guard;
  for (std::uint64_t count = 1; count <= 300; ++count) {
    (void)link_->SendTorsion(batch);
    (void)link_->Send(FrameOf(count));
    (void)port_->Read(frame, rt::MonotonicNowNs() + 5'000'000'000);
    taken += port_->TakeTorsion(into) ? 1U : 0U;
  }
  EXPECT_EQ(guard.count(), 0U);
  EXPECT_EQ(taken, 300U);
}

TEST(TorsionPacket, IsAShortMessageOfItsChannelWhosePayloadDecodesToTheSameBits) {
  TorsionPacket packet;
  TorsionBatch batch = DrawnBatch(0x0123'4567'89AB'CDEF);
  batch.torque_n_m[0] = -0.0;
  batch.twist_rad[63] = std::nan("7");
  for (std::uint32_t sequence = 0; sequence < 2; ++sequence) {
    const Packet parsed = ParsePacket(packet.Encode(batch));
    EXPECT_EQ(parsed.kind, PacketKind::kShort);
    EXPECT_EQ(parsed.sequence, sequence);
    EXPECT_EQ(parsed.channel, "LEVITAS_TORSION");
    TorsionBatch read;
    ASSERT_TRUE(TorsionCodec().Decode(parsed.payload, read));
    EXPECT_TRUE(SameReadings(read, batch));
    EXPECT_EQ(read.rig_session, kDrawn);
  }
}

TEST(TorsionPacket, HoldsTheLargestBatchInOneDatagram) {
  TorsionBatch batch;
  batch.couplings = kMaxCouplings;
  batch.samples = kTorsionSamples;
  batch.torque_n_m.fill(1.5);
  TorsionPacket packet;
  const auto datagram = packet.Encode(batch);
  ASSERT_LE(datagram.size(), kMaxDatagram);
  TorsionBatch read;
  ASSERT_TRUE(TorsionCodec().Decode(ParsePacket(datagram).payload, read));
  EXPECT_TRUE(SameReadings(read, batch));
}

}  // namespace
}  // namespace levitas::transport

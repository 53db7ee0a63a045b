// Each fault of a bus, injected on a bus of the kernel while the rotor levitates: what trips, and
// how many cycles the safe state takes.

#include <gtest/gtest.h>
#include <linux/can/error.h>

#include "hil/can_port/bus_watch.hpp"
#include "tests/hardware/can/bus_loop.hpp"
#include "tests/hardware/can/vcan.hpp"

namespace levitas::test {
namespace {

// Of the commissioned controller: 10 cycles without a frame.
constexpr int kFrameMissingCycles = 10;
// A rig that reports its amplifiers off although commanded on: controller/supervisor.
constexpr int kAmplifierAnswerCycles = 50;

class CanFault : public testing::Test {
 protected:
  void SetUp() override {
    if (!bus_.made()) GTEST_SKIP() << "this kernel has no vcan";
    loop_ = std::make_unique<BusLoop>("can:vcan7");
    intruder_ = std::make_unique<Intruder>("vcan7");
    ASSERT_TRUE(loop_->Levitate());
    ASSERT_EQ(loop_->port().Trouble(), "");
  }
  void ExpectTrip(Fault fault, int steps, int expected_steps) {
    std::cout << "  trip " << Name(loop_->out.fault) << ", amplifiers off after " << steps
              << " cycles\n";
    EXPECT_EQ(loop_->out.fault, fault);
    EXPECT_EQ(steps, expected_steps);
    EXPECT_EQ(loop_->out.mode, Mode::kTripped);
  }
  [[nodiscard]] can::WireFrame Positions(std::uint64_t cycle, std::uint32_t session = 1) {
    SensorFrame frame;
    frame.cycle = cycle;
    frame.rig_session = session;
    return codec_->Encode(can::ValuesOf(frame));
  }
  void MakeCodec() {
    for (const can::Message& message : loop_->layout().messages) {
      if (message.id == can::kPositionsId) codec_.emplace(message, loop_->layout().format);
    }
  }

  VirtualBus bus_{"vcan7"};
  std::unique_ptr<BusLoop> loop_;
  std::unique_ptr<Intruder> intruder_;
  std::optional<can::MessageCodec> codec_;
};

TEST_F(CanFault, NoneInTwentyThousandCycles) {
  for (int cycle = 0; cycle < 20'000; ++cycle) {
    ASSERT_EQ(loop_->Step().fault, Fault::kNone) << "cycle " << loop_->cycles;
  }
  EXPECT_EQ(loop_->port().counters().frames_lost, 0U);
  EXPECT_EQ(loop_->link().counters().currents_lost, 0U);
  EXPECT_EQ(loop_->port().Trouble(), "");
}

TEST_F(CanFault, SilentRigTripsAfterTheFramesThatMayBeMissing) {
  const int steps = loop_->StepsUntilOff(100, false);
  ExpectTrip(Fault::kFrameMissing, steps, kFrameMissingCycles);
}

TEST_F(CanFault, BusOffTripsThoughFramesStillArrive) {
  intruder_->SendError(CAN_ERR_BUSOFF);
  const int steps = loop_->StepsUntilOff(100);
  ExpectTrip(Fault::kFrameMissing, steps, kFrameMissingCycles);
  EXPECT_EQ(loop_->port().bus_counters().bus_off, 1U);
}

TEST_F(CanFault, BusOffThatRestartsInTimeTripsNothing) {
  intruder_->SendError(CAN_ERR_BUSOFF);
  for (int cycle = 0; cycle < kFrameMissingCycles - 2; ++cycle) loop_->Step();
  intruder_->SendError(CAN_ERR_RESTARTED);
  for (int cycle = 0; cycle < 200; ++cycle) ASSERT_EQ(loop_->Step().fault, Fault::kNone);
}

// As somebody does whose chip left the bus; no driver tells of a restart then.
TEST_F(CanFault, BusOffEndsWhenTheLinkIsTakenDownAndUp) {
  intruder_->SendError(CAN_ERR_BUSOFF);
  ExpectTrip(Fault::kFrameMissing, loop_->StepsUntilOff(100), kFrameMissingCycles);
  bus_.Set("down");
  loop_->Step();
  bus_.Set("up");
  for (int cycle = 0; cycle < 3000; ++cycle) loop_->Step();
  loop_->Step(OperatorCommand::kReset);
  loop_->Step();
  EXPECT_EQ(loop_->out.mode, Mode::kOff);
  EXPECT_EQ(loop_->out.fault, Fault::kNone);
}

TEST_F(CanFault, BusOffOfADriverThatSaysNoMoreEndsAfterTheTripWithTheFramesThatKeepComing) {
  intruder_->SendError(CAN_ERR_BUSOFF);
  ExpectTrip(Fault::kFrameMissing, loop_->StepsUntilOff(100), kFrameMissingCycles);
  // The rig's own chip heard the same error: its frames are sent from a third place.
  MakeCodec();
  loop_->between = [this] { intruder_->Send(Positions(loop_->cycles)); };
  // One was under way when the chip went off.
  for (std::uint32_t sent = 2; sent < can_port::BusWatch::kBackAfter; ++sent) {
    loop_->Step(OperatorCommand::kNone, false);
    ASSERT_EQ(loop_->port().bus_counters().returns, 0U) << sent;
  }
  for (int more = 0; more < 2; ++more) loop_->Step(OperatorCommand::kNone, false);
  EXPECT_EQ(loop_->port().bus_counters().returns, 1U);
}

TEST_F(CanFault, ErrorPassiveAndWireErrorsTripNothing) {
  intruder_->SendError(CAN_ERR_CRTL, CAN_ERR_CRTL_RX_PASSIVE);
  intruder_->SendError(CAN_ERR_PROT);
  for (int cycle = 0; cycle < 200; ++cycle) ASSERT_EQ(loop_->Step().fault, Fault::kNone);
  EXPECT_EQ(loop_->port().bus_counters().error_passive, 1U);
}

TEST_F(CanFault, DamagedFramesAreMissingFrames) {
  MakeCodec();
  loop_->between = [this] {
    can::WireFrame damaged = Positions(loop_->cycles);
    damaged.data[4] ^= 0x20U;
    intruder_->Send(damaged);
  };
  const int steps = loop_->StepsUntilOff(100, false);
  ExpectTrip(Fault::kFrameMissing, steps, kFrameMissingCycles);
}

TEST_F(CanFault, FramesUnderTheWrongIdentifierAreMissingFrames) {
  MakeCodec();
  loop_->between = [this] {
    can::WireFrame wrong = Positions(loop_->cycles);
    wrong.id = can::kPositionsId + 1;
    intruder_->Send(wrong);
  };
  const int steps = loop_->StepsUntilOff(100, false);
  ExpectTrip(Fault::kFrameMissing, steps, kFrameMissingCycles);
}

TEST_F(CanFault, ReplayedOldFramesAmongTrueOnesChangeNothing) {
  MakeCodec();
  const can::WireFrame old = Positions(loop_->cycles - 100);
  loop_->between = [&] {
    if (loop_->cycles % 3 == 0) intruder_->Send(old);
  };
  for (int cycle = 0; cycle < 300; ++cycle) ASSERT_EQ(loop_->Step().fault, Fault::kNone);
  EXPECT_GT(loop_->port().counters().frames_rejected, 90U);
}

TEST_F(CanFault, ASequenceOfOldFramesAloneIsARestartedRig) {
  MakeCodec();
  const std::uint64_t start = loop_->cycles - 1000;
  loop_->between = [&, sent = 0ULL]() mutable { intruder_->Send(Positions(start + sent++)); };
  const int steps = loop_->StepsUntilOff(100, false);
  ExpectTrip(Fault::kRigRestarted, steps, 3);  // the third in a row is believed
}

TEST_F(CanFault, ForeignBabbleStaysOutside) {
  loop_->between = [&] {
    for (int frame = 0; frame < 100; ++frame)
      intruder_->Send({.id = 0x7F0, .length = 8, .fd = true});
  };
  for (int cycle = 0; cycle < 50; ++cycle) ASSERT_EQ(loop_->Step().fault, Fault::kNone);
  EXPECT_EQ(loop_->port().Trouble(), "");
}

TEST_F(CanFault, BabbleUnderOurIdentifierIsBoundedAndTrips) {
  loop_->between = [&] {
    const can::WireFrame babble{.id = can::kPositionsId, .length = 16, .fd = true};
    for (int frame = 0; frame < 3 * can_port::kMostPerRead; ++frame) intruder_->Send(babble);
  };
  const int steps = loop_->StepsUntilOff(100);
  ExpectTrip(Fault::kFrameMissing, steps, kFrameMissingCycles);
  EXPECT_GT(loop_->port().bus_counters().read_limit, 0U);
}

TEST_F(CanFault, ALinkThatGoesDownTripsAndComesBackAfterAReset) {
  bus_.Set("down");
  const int steps = loop_->StepsUntilOff(100);
  ExpectTrip(Fault::kFrameMissing, steps, kFrameMissingCycles);
  bus_.Set("up");
  for (int cycle = 0; cycle < 3000; ++cycle) loop_->Step();
  loop_->Step(OperatorCommand::kReset);
  loop_->Step();
  EXPECT_EQ(loop_->out.mode, Mode::kOff);
  EXPECT_EQ(loop_->out.fault, Fault::kNone);
}

TEST_F(CanFault, ABusThatTakesNoCurrentsIsAStopBeforeTheRigsWatchdogReleases) {
  const VirtualBus second("vcan8");
  // The rotor falls meanwhile, and which frames the full bus still lets through decides how fast:
  // with the orbit's limit of normal use either of the two trips may come first.
  loop_ = std::make_unique<BusLoop>("can:vcan7,vcan8", "", 0.99);
  ASSERT_TRUE(loop_->Levitate());
  if (!Shell("tc qdisc add dev vcan8 root tbf rate 8bit burst 100 limit 100")) {
    GTEST_SKIP() << "this kernel has no tbf";
  }
  int rig_off = -1;
  int steps = -1;
  for (int step = 1; step <= 200 && steps < 0; ++step) {
    loop_->Step();
    if (rig_off < 0 && !loop_->rig_energised()) rig_off = step;
    if (!loop_->out.current.amplifiers_enabled) steps = step;
  }
  std::cout << "  rig off after " << rig_off << " cycles, trip " << Name(loop_->out.fault)
            << " after " << steps << "\n";
  EXPECT_NEAR(rig_off, static_cast<int>(BusLoop::kWatchdogPeriods), 2);  // the bucket's first frame
  // The first cause, a levitated stop before the watchdog; the amplifiers' silence releases.
  EXPECT_EQ(loop_->out.fault, Fault::kCurrentsLate);
  EXPECT_NEAR(steps, rig_off + kAmplifierAnswerCycles, 3);
  EXPECT_GT(loop_->port().bus_counters().full, 50U);
}

// Two ends of one wire, so that what the kernel does to frames on their way (netem) lies between
// rig and controller.
class CanWire : public testing::Test {
 protected:
  void SetUp() override {
    if (!wire_.made()) GTEST_SKIP() << "this kernel has no vxcan";
    loop_ = std::make_unique<BusLoop>("can:vxcan7", "can:vxcan8");
    ASSERT_TRUE(loop_->Levitate());
  }
  [[nodiscard]] static bool Spoil(const std::string& how) {
    return Shell("tc qdisc add dev vxcan7 root netem " + how);
  }

  VirtualWire wire_{"vxcan7", "vxcan8"};
  std::unique_ptr<BusLoop> loop_;
};

TEST_F(CanWire, DuplicatedFramesChangeNothing) {
  if (!Spoil("duplicate 100%")) GTEST_SKIP() << "this kernel has no netem";
  for (int cycle = 0; cycle < 300; ++cycle) ASSERT_EQ(loop_->Step().fault, Fault::kNone);
  EXPECT_GT(loop_->port().outcomes()[can::Outcome::kRepeated], 250U);
}

TEST_F(CanWire, LostFramesTripOnlyWhenTooManyAreMissingInARow) {
  if (!Spoil("loss 10%")) GTEST_SKIP() << "this kernel has no netem";
  // Ten in a row at 10 %: 1e-10 a cycle. 30 of 100 trip, too, which is 6.7 deviations above 10.
  for (int cycle = 0; cycle < 600; ++cycle) ASSERT_EQ(loop_->Step().fault, Fault::kNone);
  // 60 expected, standard deviation 7; 5 of them.
  EXPECT_GT(loop_->port().counters().frames_lost, 25U);
}

TEST_F(CanWire, AWireThatLosesEverythingTrips) {
  if (!Spoil("loss 100%")) GTEST_SKIP() << "this kernel has no netem";
  EXPECT_EQ(loop_->StepsUntilOff(100), kFrameMissingCycles);
  EXPECT_EQ(loop_->out.fault, Fault::kFrameMissing);
}

}  // namespace
}  // namespace levitas::test

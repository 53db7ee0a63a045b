#include "hil/can/layout.hpp"

#include <gtest/gtest.h>

#include <bitset>
#include <cmath>
#include <set>
#include <tuple>

#include "hil/can/wire_frame.hpp"
#include "tests/unit/can/rigs.hpp"

namespace levitas::can {
namespace {

TEST(Layout, OfFourAxesTakesSixteenAndTwelveBytes) {
  const Layout layout = MakeLayout(TestRig(4), Format::kFd);
  EXPECT_EQ(MessageNamed(layout, "RigPositions").bytes, 16);
  EXPECT_EQ(MessageNamed(layout, "ControllerCurrents").bytes, 12);
  EXPECT_EQ(MessageNamed(layout, "ControllerDrive").bytes, 8);
  for (const Message& message : layout.messages) EXPECT_EQ(message.profile, Profile::k11);
}

TEST(Layout, StepsAreTenNanometresAndATenthOfAMilliampere) {
  const Layout layout = MakeLayout(TestRig(4), Format::kFd);
  EXPECT_EQ(MessageNamed(layout, "RigPositions").signals[4].factor, 1e-8);
  EXPECT_EQ(MessageNamed(layout, "ControllerCurrents").signals[3].factor, 1e-4);
}

TEST(Layout, StepsGrowUntilTheRangeOfTheRigFits) {
  RigNumbers rig = TestRig(4);
  rig.sensor_range_m = 400e-6;  // 16 bits of 10 nm end at 328 um
  rig.max_coil_current_a = 20.0;
  const Layout layout = MakeLayout(rig, Format::kFd);
  EXPECT_DOUBLE_EQ(MessageNamed(layout, "RigPositions").signals[4].factor, 2e-8);
  EXPECT_DOUBLE_EQ(MessageNamed(layout, "ControllerCurrents").signals[3].factor, 1e-3);
}

TEST(Layout, StepsFitTheWidestProbe) {
  RigNumbers rig = TestRig(4);
  rig.sensor_range_m = 300e-6;
  rig.sensor_ranges_m = {300e-6, 400e-6};
  const Layout layout = MakeLayout(rig, Format::kFd);
  EXPECT_DOUBLE_EQ(MessageNamed(layout, "RigPositions").signals[4].factor, 2e-8);
}

TEST(Layout, OfMoreAxesIsProtectedByTheLongerChecksum) {
  const Layout layout = MakeLayout(TestRig(8), Format::kFd);
  EXPECT_EQ(MessageNamed(layout, "RigPositions").profile, Profile::k5);
  EXPECT_EQ(MessageNamed(layout, "RigPositions").bytes, 32);
  EXPECT_EQ(MessageNamed(layout, "ControllerCurrents").bytes, 24);
}

TEST(Layout, OfClassicalCanHoldsTwoAxesAFrameInEightBytes) {
  const Layout layout = MakeLayout(TestRig(4), Format::kClassical);
  for (const char* name : {"RigPositions1", "RigPositions2", "ControllerCurrents1",
                           "ControllerCurrents2", "ControllerDrive", "RigRotation"}) {
    EXPECT_LE(MessageNamed(layout, name).bytes, 8) << name;
  }
}

class EveryLayout : public testing::TestWithParam<std::tuple<std::size_t, Format>> {};

TEST_P(EveryLayout, GivesEachBitToOneSignalAtMost) {
  const auto [axes, format] = GetParam();
  for (const Message& message : MakeLayout(TestRig(axes), format).messages) {
    std::bitset<8 * kMaxPayload> taken;
    for (unsigned bit = 0; bit < ProtectionBits(message.profile); ++bit) taken.set(bit);
    for (const Signal& signal : message.signals) {
      for (unsigned bit = 0; bit < signal.bits; ++bit) {
        const unsigned at = signal.start_bit + bit;
        ASSERT_LT(at, 8U * message.bytes) << message.name << " " << signal.name;
        ASSERT_FALSE(taken.test(at)) << message.name << " " << signal.name;
        taken.set(at);
      }
    }
  }
}

TEST_P(EveryLayout, CarriesEveryAxisOnceInEachDirection) {
  const auto [axes, format] = GetParam();
  std::multiset<int> positions;
  std::multiset<int> currents;
  for (const Message& message : MakeLayout(TestRig(axes), format).messages) {
    for (const Signal& signal : message.signals) {
      if (signal.field == Field::kPosition) positions.insert(signal.axis);
      if (signal.field == Field::kCurrent) currents.insert(signal.axis);
    }
  }
  EXPECT_EQ(positions.size(), axes);
  EXPECT_EQ(std::set<int>(positions.begin(), positions.end()).size(), axes);
  EXPECT_EQ(currents, positions);
}

TEST_P(EveryLayout, HasIdentifiersOfElevenBitsThatDiffer) {
  const auto [axes, format] = GetParam();
  std::set<std::uint32_t> ids;
  for (const Message& message : MakeLayout(TestRig(axes), format).messages) {
    EXPECT_LT(message.id, 0x800U);
    EXPECT_TRUE(ids.insert(message.id).second);
    EXPECT_EQ(message.data_id(), message.id);
  }
}

INSTANTIATE_TEST_SUITE_P(AxesAndFormats, EveryLayout,
                         testing::Combine(testing::Values(1, 2, 3, 4, 5, 6, 7, 8),
                                          testing::Values(Format::kFd, Format::kClassical)));

TEST(Layout, RefusesRigsWithoutAxesOrWithTooMany) {
  EXPECT_THROW(std::ignore = MakeLayout(TestRig(0), Format::kFd), std::invalid_argument);
  EXPECT_THROW(std::ignore = MakeLayout(TestRig(9), Format::kFd), std::invalid_argument);
}

TEST(Layout, CurrentsWinTheBusOverPositionsOverSlowMessages) {
  EXPECT_LT(kCurrentsId + 3, kPositionsId);
  EXPECT_LT(kPositionsId + 3, kDriveId);
  EXPECT_LT(kDriveId, kRotationId);
}

BusConfig Bus(Carries carries, double data_rate = 5e6) {
  return {"bus", "can0", {1e6, data_rate}, carries, 0.8};
}

TEST(Buses, EachMessageGoesToTheBusOfItsDirection) {
  const Layout layout = MakeLayout(TestRig(4), Format::kFd);
  const std::vector<BusConfig> buses{Bus(Carries::kFromRig), Bus(Carries::kToRig)};
  EXPECT_EQ(BusOf(MessageNamed(layout, "RigPositions"), buses), 0U);
  EXPECT_EQ(BusOf(MessageNamed(layout, "ControllerCurrents"), buses), 1U);
  EXPECT_EQ(BusOf(MessageNamed(layout, "ControllerDrive"), buses), 1U);
  EXPECT_THROW(static_cast<void>(BusOf(MessageNamed(layout, "ControllerDrive"), {buses[0]})),
               std::invalid_argument);
}

TEST(Buses, AreAllFdOrAllClassical) {
  EXPECT_EQ(FormatOf({Bus(Carries::kEverything)}), Format::kFd);
  EXPECT_EQ(FormatOf({Bus(Carries::kEverything, 0.0)}), Format::kClassical);
  EXPECT_THROW(static_cast<void>(FormatOf({Bus(Carries::kFromRig), Bus(Carries::kToRig, 0.0)})),
               std::invalid_argument);
}

}  // namespace
}  // namespace levitas::can

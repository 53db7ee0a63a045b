// The delay that the frames themselves tell, against delays that the test makes.

#include "hil/can_port/delay_meter.hpp"

#include <gtest/gtest.h>

#include "tests/unit/can_port/fake_bus.hpp"

namespace levitas::can_port {
namespace {

constexpr std::int64_t kPeriodNs = 100'000;
// A bin of the histogram is 4.4 % wide, and a percentile is its upper edge.
constexpr double kBin = 0.045;

/// Frames of a rig and a controller, each with the time stamp that a kernel would give it.
class DelayMeterTest : public testing::Test {
 protected:
  void Use(can::Acts acts, bool virtual_bus) {
    std::vector<can::BusConfig> buses = TwoBuses();
    buses[1].current_acts = acts;
    budget_ = can::MakeBudget(layout_, buses);
    meter_.emplace(layout_, budget_, virtual_bus);
    for (const can::Message& message : layout_.messages) {
      if (message.id == can::kPositionsId) positions_.emplace(message, layout_.format);
      if (message.id == can::kCurrentsId) currents_.emplace(message, layout_.format);
    }
  }
  void Positions(std::uint64_t cycle, std::int64_t stamp_ns) {
    SensorFrame frame;
    frame.cycle = cycle;
    Take(positions_->Encode(can::ValuesOf(frame)), stamp_ns);
  }
  void Currents(std::uint64_t cycle, std::int64_t stamp_ns) {
    CurrentFrame frame;
    frame.cycle = cycle;
    Take(currents_->Encode(can::ValuesOf(frame, false)), stamp_ns);
  }
  void Take(can::WireFrame frame, std::int64_t stamp_ns) {
    frame.received_ns = stamp_ns;
    meter_->Take(frame);
  }
  [[nodiscard]] static std::int64_t Instant(std::uint64_t cycle) {
    return 1'000'000 + static_cast<std::int64_t>(cycle) * kPeriodNs;
  }

  can::Layout layout_ = can::MakeLayout(can::TestRig(4), can::Format::kFd);
  can::Budget budget_;
  std::optional<DelayMeter> meter_;
  std::optional<can::MessageCodec> positions_, currents_;
};

// Positions end 72.6 us after the sampling instant, as the budget says; currents 170 us after it.
TEST_F(DelayMeterTest, CountsFromTheSamplingInstantToTheEndOfTheCurrentsOnTheWire) {
  Use(can::Acts::kOnArrival, false);
  for (std::uint64_t cycle = 0; cycle < 5000; ++cycle) {
    Positions(cycle, Instant(cycle) + 72'600);
    if (cycle > 0) Currents(cycle - 1, Instant(cycle - 1) + 170'000);
  }
  const DelayFigures figures = meter_->Acting();
  EXPECT_EQ(figures.count, 4999U);
  EXPECT_NEAR(figures.least_periods, 1.7, 1e-3);  // the budget's 72.6 us in whole nanoseconds
  EXPECT_NEAR(figures.median_periods, 1.7, kBin * 1.7);
  EXPECT_NEAR(figures.most_periods, 1.7, 1e-3);
}

TEST_F(DelayMeterTest, RoundsUpToTheSampleAtWhichTheRigLetsACurrentAct) {
  Use(can::Acts::kAtNextSample, false);
  for (std::uint64_t cycle = 0; cycle < 100; ++cycle) {
    Positions(cycle, Instant(cycle) + 72'600);
    Currents(cycle, Instant(cycle) + (cycle == 50 ? 230'000 : 170'000));
  }
  EXPECT_EQ(meter_->Acting().median_periods, 2.0);
  EXPECT_EQ(meter_->Acting().most_periods, 3.0);
  EXPECT_NEAR(meter_->Arrived().most_periods, 2.3, 1e-3);
}

// 35 us from one program to the other; both times on the wire are what a real bus would add.
TEST_F(DelayMeterTest, AddsTheTimesOnTheWireThatAVirtualBusDoesNotTake) {
  Use(can::Acts::kOnArrival, true);
  for (std::uint64_t cycle = 0; cycle < 100; ++cycle) {
    Positions(cycle, Instant(cycle));
    Currents(cycle, Instant(cycle) + 35'000);
  }
  EXPECT_NEAR(meter_->Acting().most_periods, 1.722, 1e-3);
  EXPECT_NEAR(meter_->Acting().most_periods, can::DelayOf(budget_).total_s() * 1e9 / kPeriodNs,
              1e-3);
}

// Two buses are read one after the other, each as far as it goes.
TEST_F(DelayMeterTest, PairsThemInWhateverOrderTheyAreRead) {
  Use(can::Acts::kOnArrival, false);
  for (std::uint64_t cycle = 0; cycle < 200; ++cycle) Currents(cycle, Instant(cycle) + 170'000);
  for (std::uint64_t cycle = 0; cycle < 200; ++cycle) Positions(cycle, Instant(cycle) + 72'600);
  EXPECT_EQ(meter_->Acting().count, 200U);
  EXPECT_NEAR(meter_->Acting().most_periods, 1.7, 1e-3);
}

TEST_F(DelayMeterTest, MeasuresNothingOfRepeatedAnswersLostFramesAndFramesWithoutAStamp) {
  Use(can::Acts::kOnArrival, false);
  Positions(1, Instant(1) + 72'600);
  Currents(1, Instant(1) + 170'000);
  Currents(1, Instant(1) + 270'000);  // the controller had no frame and repeats
  Positions(2, Instant(2) + 72'600);  // never answered
  Currents(3, Instant(3) + 170'000);  // of positions that were lost
  Positions(4, 0);
  Currents(4, Instant(4) + 170'000);
  EXPECT_EQ(meter_->Acting().count, 1U);
}

}  // namespace
}  // namespace levitas::can_port

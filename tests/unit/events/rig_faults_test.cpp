#include "plant_sim/events/rig_faults.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "tests/support/allocation_guard.hpp"

namespace levitas::events {
namespace {

constexpr double kFaultPeriod_s = 1e-3;

ScheduledRigEvent Event(RigEventKind kind, double at_s, double duration_s, std::size_t axis = 1,
                        double value_m = 0.0) {
  ScheduledRigEvent event;
  event.kind = kind;
  event.at_s = at_s;
  event.duration_s = duration_s;
  event.axis = axis;
  event.value_m = value_m;
  return event;
}

SensorFrame Frame(std::uint64_t cycle) {
  SensorFrame frame;
  frame.axes = 4;
  for (std::size_t i = 0; i < 4; ++i) {
    frame.position_m[i] = 1e-6 * static_cast<double>(10 * i + cycle);
  }
  return frame;
}

TEST(RigFaults, ActFromTheirFirstCycleToTheLastAndOnNoOtherAxis) {
  RigFaults faults({Event(RigEventKind::kSensorStuck, 0.010, 0.005, 1, 7e-6)}, kFaultPeriod_s);
  for (std::uint64_t cycle = 0; cycle < 30; ++cycle) {
    SensorFrame frame = Frame(cycle);
    faults.Disturb(cycle, frame);
    SensorFrame expected = Frame(cycle);
    if (cycle >= 10 && cycle < 15) expected.position_m[1] = 7e-6;
    ASSERT_EQ(frame.position_m, expected.position_m) << cycle;
    ASSERT_EQ(frame.rig_status, 0U);
  }
}

TEST(RigFaults, WithoutADurationStayForGood) {
  RigFaults faults({Event(RigEventKind::kAmplifierFault, 0.010, 0.0)}, kFaultPeriod_s);
  SensorFrame before = Frame(9);
  faults.Disturb(9, before);
  EXPECT_EQ(before.rig_status, 0U);
  SensorFrame late = Frame(0);
  faults.Disturb(1'000'000'000, late);
  EXPECT_EQ(late.rig_status, kRigAmplifierFault);
}

TEST(RigFaults, AFrozenSensorRepeatsTheReadingOfItsFirstCycle) {
  RigFaults faults({Event(RigEventKind::kSensorFrozen, 0.002, 0.003)}, kFaultPeriod_s);
  for (std::uint64_t cycle = 0; cycle < 8; ++cycle) {
    SensorFrame frame = Frame(cycle);
    faults.Disturb(cycle, frame);
    const bool frozen = cycle >= 2 && cycle < 5;
    EXPECT_EQ(frame.position_m[1], Frame(frozen ? 2 : cycle).position_m[1]) << cycle;
  }
}

TEST(RigFaults, JumpAddsAndInvalidIsNotANumber) {
  RigFaults faults({Event(RigEventKind::kSensorJump, 0.0, 0.0, 0, 5e-6),
                    Event(RigEventKind::kSensorInvalid, 0.0, 0.0, 3)},
                   kFaultPeriod_s);
  SensorFrame frame = Frame(2);
  faults.Disturb(2, frame);
  EXPECT_EQ(frame.position_m[0], Frame(2).position_m[0] + 5e-6);
  EXPECT_TRUE(std::isnan(frame.position_m[3]));
}

TEST(RigFaults, EmergencyStopOpensTheChainForAsLongAsItLasts) {
  RigFaults faults({Event(RigEventKind::kEmergencyStop, 0.001, 0.001)}, kFaultPeriod_s);
  for (std::uint64_t cycle = 0; cycle < 4; ++cycle) {
    SensorFrame frame = Frame(cycle);
    faults.Disturb(cycle, frame);
    EXPECT_EQ(frame.rig_status, cycle == 1 ? kRigEmergencyStop : 0U);
  }
}

TEST(RigFaults, LeaveChangesOfEffectsToThePlant) {
  EXPECT_TRUE(RigFaults({Event(RigEventKind::kEffect, 0.0, 0.0)}, kFaultPeriod_s).empty());
}

TEST(RigFaults, RefuseAPeriodThatIsNotPositiveAndAnAxisThatIsNotThere) {
  EXPECT_THROW(RigFaults({}, 0.0), std::invalid_argument);
  EXPECT_THROW(RigFaults({}, std::nan("")), std::invalid_argument);
  EXPECT_THROW(RigFaults({Event(RigEventKind::kSensorStuck, 0.0, 0.0, kMaxAxes)}, kFaultPeriod_s),
               std::invalid_argument);
}

TEST(RigFaults, AllocateNothing) {
  RigFaults faults({Event(RigEventKind::kSensorFrozen, 0.5, 2.0)}, kFaultPeriod_s);
  const test::AllocationGuard guard;
  for (std::uint64_t cycle = 0; cycle < 10'000; ++cycle) {
    SensorFrame frame = Frame(cycle % 7);
    faults.Disturb(cycle, frame);
  }
  EXPECT_EQ(guard.count(), 0U);
}

}  // namespace
}  // namespace levitas::events

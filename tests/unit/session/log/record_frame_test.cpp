#include "session/log/record_frame.hpp"

#include <gtest/gtest.h>

namespace levitas::session {
namespace {

/// Probe of the second axis and coils of the third are wired the other way round.
RigNumbers Reversed() {
  RigNumbers rig;
  rig.channels = {"de_x", "de_y", "nde_x", "nde_y"};
  rig.sensor_polarity = {1, -1, 1, 1};
  rig.actuator_polarity = {1, 1, -1, 1};
  return rig;
}

TEST(RecordFrame, TurnsReadingsByTheProbesAndCommandsByTheCoilsOnly) {
  cycle::CycleRecord record;
  record.in.frame.position_m = {1e-6, 2e-6, 3e-6, 4e-6};
  record.out.current.control_current_a = {0.1, 0.2, 0.3, 0.4};
  const AxisSample sample = RecordFrame(Reversed()).Bearing(record);
  EXPECT_EQ(sample.position_m, (AxisArray{1e-6, -2e-6, 3e-6, 4e-6}));
  EXPECT_EQ(sample.current_a, (AxisArray{0.1, 0.2, -0.3, 0.4}));
}

TEST(RecordFrame, PutsASampleBackOntoTheWiresFromWhichItCame) {
  const RecordFrame frame(Reversed());
  const AxisSample wired{{1e-6, -2e-6, 3e-6, 4e-6}, {0.1, 0.2, 0.3, -0.4}};
  const AxisSample back = frame.Wired(frame.Bearing(wired));
  EXPECT_EQ(back.position_m, wired.position_m);
  EXPECT_EQ(back.current_a, wired.current_a);
}

}  // namespace
}  // namespace levitas::session

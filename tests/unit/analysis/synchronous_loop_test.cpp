// Speeds at which blocks of synchronous control are judged.

#include "analysis/synchronous_loop.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "common/rotational_speed.hpp"
#include "controller/synchronous/inverse_ladder.hpp"

namespace levitas::analysis {
namespace {

/// Each of these speeds is one at which the block acts, its last included: a sum that rounds beyond
/// the window found no block there, and the design refused what was sound.
TEST(JudgedSpeeds, LieWithinTheWindowWhateverItIs) {
  for (int to_rpm = 2000; to_rpm < 60'000; to_rpm += 250) {
    synchronous::SynchronousConfig control;
    synchronous::BlockConfig& block = control.blocks.emplace_back();
    block.from_rad_per_s = RpmToRadPerS(1500.0);
    block.to_rad_per_s = RpmToRadPerS(to_rpm);
    block.hysteresis_rad_per_s = RpmToRadPerS(30.0);
    const std::vector<double> speeds = JudgedSpeeds(control, 40);
    ASSERT_EQ(speeds.size(), 40U);
    for (const double speed : speeds) {
      EXPECT_TRUE(synchronous::ActsAt(block, speed)) << to_rpm << " " << speed;
    }
  }
}

}  // namespace
}  // namespace levitas::analysis

// T of the file's rig on rigs that differ from it: a hundred drawn ones for each target.
#include <gtest/gtest.h>

#include <algorithm>

#include "analysis/synchronous_loop.hpp"
#include "common/random.hpp"
#include "design/drawn_rigs/rig_uncertainty.hpp"
#include "tests/loop/synchronous/notch_loop.hpp"
#include "tests/support/modes_within.hpp"

namespace levitas::test {
namespace {

using synchronous::BlockState;
using synchronous::Target;

/// Gains +-10 %, modes +-3 %, delay +-0.3 samples, all drawn anew.
plant::PlantConfig DrawnRig(Random& draw) {
  const configuration::RigFile& rig = ShippedRig();
  const auto parameters =
      ModesWithin(0.03, uncertainty::Stated(rig, {.current_gain = 0.1, .stiffness = 0.1}));
  configuration::RigFile drawn =
      uncertainty::At(rig, parameters, uncertainty::DrawPlace(draw, parameters.size()));
  drawn.plant.delay_samples += 0.3 * (2.0 * draw.Uniform() - 1.0);
  return drawn.plant;
}

class OfDrawnRigs : public testing::TestWithParam<Target> {};

TEST_P(OfDrawnRigs, NoneOfAHundredIsUnstable) {
  const double top_rpm = GetParam() == Target::kCurrent ? 4400.0 : 3400.0;
  const auto cycle = WithBlock(Asked(GetParam(), 1500.0, top_rpm));
  Random draw(41);
  double slowest = 1.0;
  for (int n = 0; n < 100; ++n) {
    const auto rig = DrawnRig(draw);
    const double rpm = 1550.0 + (top_rpm - 1600.0) * draw.Uniform();
    const double speed = RpmToRadPerS(rpm);
    const auto judged = analysis::JudgeSynchronous(analysis::CloseLoop(rig, cycle.law, speed),
                                                   cycle.synchronous, speed);
    EXPECT_TRUE(judged.stable()) << "rig " << n << " at " << rpm << " rpm: |z| "
                                 << judged.largest_pole_modulus;
    slowest = std::min(slowest, judged.blocks.front().slowest_decay);
    ClosedLoop loop(cycle, rig, static_cast<std::uint64_t>(n));
    ASSERT_TRUE(loop.Levitate());
    loop.SpinAt(rpm);
    loop.Run(2.0);
    EXPECT_EQ(loop.out.fault, Fault::kNone) << "rig " << n << " at " << rpm << " rpm";
    EXPECT_EQ(loop.out.synchronous[0].state, BlockState::kActing) << "rig " << n;
  }
  RecordProperty("slowest_decay", std::to_string(slowest));
}

INSTANTIATE_TEST_SUITE_P(OfBothTargets, OfDrawnRigs,
                         testing::Values(Target::kCurrent, Target::kVibration));

}  // namespace
}  // namespace levitas::test

// A run-up through the whole speed range with blocks that come and go.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/loop/synchronous/notch_loop.hpp"

namespace levitas::test {
namespace {

using synchronous::BlockState;
using synchronous::Ending;
using synchronous::Target;

struct RunUp {
  double peak_orbit_m{};
  double largest_step_a{};  ///< of a current from one period to the next, noise included
  Turning at_top;
  bool tripped{};
  std::vector<int> began;
  std::vector<Ending> endings;
};

RunUp RunUpWith(const cycle::CycleConfig& config) {
  ClosedLoop loop(config);
  RunUp run;
  EXPECT_TRUE(loop.Levitate());
  loop.Run(1.0);
  loop.Reset();
  run.began.resize(config.synchronous.blocks.size());
  loop.Command(OperatorCommand::kSpin, 6000.0, 800.0);
  AxisArray before = loop.out.current.control_current_a;
  std::vector<BlockState> state(run.began.size(), BlockState::kOff);
  EXPECT_TRUE(loop.RunUntil(20.0, [&] {
    const AxisArray& now = loop.out.current.control_current_a;
    for (std::size_t i = 0; i < 4; ++i) {
      run.largest_step_a = std::max(run.largest_step_a, std::abs(now[i] - before[i]));
    }
    before = now;
    for (std::size_t k = 0; k < state.size(); ++k) {
      const auto& status = loop.out.synchronous[k];
      if (status.state == BlockState::kActing && state[k] != BlockState::kActing) ++run.began[k];
      if (status.state == BlockState::kFading && state[k] == BlockState::kActing) {
        run.endings.push_back(status.ending);
      }
      state[k] = status.state;
    }
    return loop.speed_rpm() > 5999.0;
  }));
  loop.Run(3.0);
  run.peak_orbit_m = loop.most.orbit_m;
  run.at_top = Measure(loop, 100);
  run.tripped = loop.out.fault != Fault::kNone;
  return run;
}

TEST(RunUpWithBlocks, PassesTheFirstBendingWithNoLargerOrbitThanThePlainLaw) {
  const RunUp plain = RunUpWith(CommissionedCycle());
  cycle::CycleConfig config = WithBlock(Asked(Target::kCurrent, 1500.0, 3900.0));
  config.synchronous.blocks.push_back(
      WithBlock(Asked(Target::kVibration, 4700.0, 6000.0)).synchronous.blocks.front());
  const RunUp quiet = RunUpWith(config);
  EXPECT_FALSE(quiet.tripped);
  EXPECT_LE(quiet.peak_orbit_m, plain.peak_orbit_m);
  EXPECT_EQ(quiet.began, (std::vector<int>{1, 1}));
  EXPECT_EQ(quiet.endings, std::vector<Ending>{Ending::kSpeed});
  EXPECT_LT(quiet.at_top.position_m, 0.01 * plain.at_top.position_m) << "-40 dB at 6000 rpm";
  // Coming and going is no step: the largest change of a current is the noise's, as without blocks.
  EXPECT_LT(quiet.largest_step_a, 1.05 * plain.largest_step_a);
}

TEST(RunUpWithBlocks, CurrentRejectionThroughTheCriticalSpeedIsEndedBeforeItTrips) {
  // Asked for where the design refuses it: the orbit grows, and the block gives way.
  const RunUp forced = RunUpWith(WithBlock(Asked(Target::kCurrent, 1500.0, 6000.0)));
  EXPECT_FALSE(forced.tripped);
  ASSERT_FALSE(forced.endings.empty());
  EXPECT_EQ(forced.endings.front(), Ending::kOrbitGrew);
}

}  // namespace
}  // namespace levitas::test

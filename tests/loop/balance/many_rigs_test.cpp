// What drawn_rigs_test.cpp has in small; the figures of docs/identification.md are these.
#include "design/drawn_rigs/healthy_rig.hpp"
#include "tests/loop/balance/drawn_figures.hpp"

namespace levitas::balancing {
namespace {

constexpr std::uint64_t kRigs = 24;

TEST(ManyRigs, GainsModesAndDamping) {
  std::vector<Outcome> all;
  for (std::uint64_t seed = 1; seed <= kRigs; ++seed) {
    all.push_back(BalanceDrawnRig(DrawRig(seed), seed));
  }
  Print("gains 10 %, modes 3 %, damping 50 %", all);
  ExpectBalanced(all);
}

/// Besides: probes' scale, place, offset, run-out, all bandwidths, delay, mass, gyroscopic effect,
/// loads, each with the deviation of the rig file's tolerances.
TEST(ManyRigs, EverythingThatAHealthyRigMayDifferBy) {
  std::vector<Outcome> all;
  for (std::uint64_t seed = 1; seed <= kRigs; ++seed) {
    Random draw(seed + 500);
    all.push_back(BalanceDrawnRig(uncertainty::DrawWithin(DrawRig(seed), draw), seed));
  }
  Print("everything within its tolerances besides", all);
  for (const Outcome& one : all) {
    EXPECT_LT(one.rms_percent, 3.0);
  }
  EXPECT_LT(SpreadOf(all, &Outcome::rms_percent).median, 1.5);
}

}  // namespace
}  // namespace levitas::balancing

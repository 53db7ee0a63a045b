// A probe that jumps is told from a glitch, from a load and from a rotor that moves.
#include "verdict/probe_jumps.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "configuration/rig_file.hpp"
#include "tests/support/paths.hpp"
#include "tests/unit/verdict/synthetic_session.hpp"

namespace levitas::verdict {
namespace {

constexpr double kJumpM = 80e-6;
constexpr std::size_t kAxis = 2;  // nde_x

const config::RigFile& Rig() {
  static const config::RigFile rig =
      config::LoadRig(test::SourceFolder() + "/config/rigs/flexible_rotor.yaml");
  return rig;
}

/// ks/ki = i0/s0 of a magnet in differential driving mode.
double CurrentPerMetre() {
  const auto& magnet = Rig().plant.bearings[1].magnet;
  return magnet.bias_current_a / magnet.gap_m;
}

/// Levitated at rest with a probe that reads `wrong_m` for the first cycles after 1 s and `later_m`
/// from then on, under a current that changes by `current_a` 0.1 s after that.
std::vector<ProbeJump> Found(double wrong_m, double later_m, double current_a,
                             Mode mode = Mode::kLevitating) {
  SyntheticSession session;
  session.Append(mode, 10'000, {.static_a = 0.2});
  session.Append(mode, 1'000, {.static_a = 0.2},
                 [&](cycle::CycleRecord& record) { record.in.frame.position_m[kAxis] = wrong_m; });
  session.Append(mode, 10'000, {.static_a = 0.2}, [&](cycle::CycleRecord& record) {
    record.in.frame.position_m[kAxis] = later_m;
    record.out.current.control_current_a[kAxis] += current_a;
  });
  ProbeJumps jumps(Rig(), 1.0, 0.0);
  for (const auto& record : session.records()) jumps.Add(record);
  return jumps.Found();
}

TEST(ProbeJumps, AreFoundByWhatTheNewPlaceCosts) {
  // The law integrates: the reading is back at zero, the magnet holds what stands 80 um off.
  const auto found = Found(kJumpM, 0.0, kJumpM * CurrentPerMetre());
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].channel, "nde_x");
  EXPECT_NEAR(found[0].time_s, 1.0, 1e-9);
  EXPECT_NEAR(found[0].step_m, kJumpM, 1e-12);
  // ks of an ideal magnet at its centre; what iron takes of both slopes leaves their ratio.
  EXPECT_NEAR(found[0].moved_m, kJumpM, 0.05 * kJumpM);
  EXPECT_FALSE(found[0].touches);
}

TEST(ProbeJumps, OfALawThatDoesNotIntegrateLeaveAReading) {
  const auto found = Found(kJumpM, -0.5 * kJumpM, 1.5 * kJumpM * CurrentPerMetre());
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].moved_m, kJumpM, 0.1 * kJumpM);
}

TEST(ProbeJumps, AreNoGlitchThatGoesBack) { EXPECT_TRUE(Found(kJumpM, 0.0, 0.0).empty()); }

TEST(ProbeJumps, AreNoLoadThatIsCarriedSince) {
  EXPECT_TRUE(Found(kJumpM, 0.0, -kJumpM * CurrentPerMetre()).empty());
}

TEST(ProbeJumps, AreNoStepThatARotorCouldMake) {
  const double small_m = 0.09 * Rig().numbers.ClearanceOf(1);
  EXPECT_TRUE(Found(small_m, 0.0, small_m * CurrentPerMetre()).empty());
}

TEST(ProbeJumps, AreNotSoughtWhereTheRotorIsMovedOnPurpose) {
  EXPECT_TRUE(Found(kJumpM, 0.0, kJumpM * CurrentPerMetre(), Mode::kLift).empty());
}

TEST(ProbeJumps, ThatPutTheRotorIntoItsTouchdownBearingSaySo) {
  const double clearance_m = Rig().numbers.ClearanceOf(1);
  // The bearing carries: the current is far from what the place would cost the magnets.
  const auto found = Found(kJumpM, kJumpM - 0.95 * clearance_m, 0.3);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(found[0].touches);
}

}  // namespace
}  // namespace levitas::verdict

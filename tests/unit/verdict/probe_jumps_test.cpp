// ProbeJumps finds a probe that jumped, and takes no glitch, load or moving rotor for one.
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

const configuration::RigFile& Rig() {
  static const configuration::RigFile rig =
      configuration::LoadRig(test::SourceFolder() + "/config/rigs/flexible_rotor.yaml");
  return rig;
}

/// ks/ki = i0/s0 of a magnet in differential driving mode.
double CurrentPerMetre() {
  const auto& magnet = Rig().plant.bearings[1].magnet;
  return magnet.bias_current_a / magnet.gap_m;
}

/// Levitated at rest. From a cycle on the probe of nde_x reads so much more, and its current is so
/// much larger.
struct Change {
  int cycle{};
  double reading_m{}, current_a{};
};

std::vector<ProbeJump> Found(const std::vector<Change>& changes, Mode mode = Mode::kLevitating) {
  SyntheticSession session;
  int now = 0;
  session.Append(mode, 30'000, {.static_a = 0.2}, [&](cycle::CycleRecord& record) {
    for (const Change& change : changes) {
      if (now < change.cycle) continue;
      record.in.frame.position_m[kAxis] += change.reading_m;
      record.out.current.control_current_a[kAxis] += change.current_a;
    }
    ++now;
  });
  ProbeJumps jumps(Rig(), 1.0, 0.5);
  for (const auto& record : session.records()) jumps.Add(record);
  return jumps.Found();
}

std::vector<Change> operator+(std::vector<Change> a, const std::vector<Change>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// A jump that the law follows within 10 ms: the reading is back, and the magnet holds the rotor
/// where it stands now.
std::vector<Change> Slowly(int cycle, double jump_m) {
  std::vector<Change> changes{{cycle, jump_m, 0.0}};
  for (int i = 0; i < 100; ++i)
    changes.push_back({cycle + 20 + i, -0.01 * jump_m, 0.01 * jump_m * CurrentPerMetre()});
  return changes;
}

TEST(ProbeJumps, AreFoundByWhatTheNewPlaceCosts) {
  const auto found = Found(Slowly(10'000, kJumpM));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].channel, "nde_x");
  EXPECT_NEAR(found[0].time_s, 1.0, 1e-9);
  EXPECT_NEAR(found[0].step_m, kJumpM, 1e-12);
  EXPECT_NEAR(found[0].current_a, kJumpM * CurrentPerMetre(), 1e-6);
  ASSERT_TRUE(found[0].moved_m.has_value());
  // The sensor is not at the magnet, and the other end is held: within a tenth.
  EXPECT_NEAR(*found[0].moved_m, kJumpM, 0.1 * kJumpM);
  EXPECT_FALSE(found[0].returns);
}

TEST(ProbeJumps, OfALawThatDoesNotIntegrateLeaveAReading) {
  // Half a jump is left on the other side, and the magnet holds half as much again.
  auto changes = Slowly(10'000, 1.5 * kJumpM);
  changes.front().reading_m = kJumpM;
  const auto found = Found(changes);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].moved_m.value(), kJumpM, 0.15 * kJumpM);
}

TEST(ProbeJumps, OfTheSameProbeAreSummed) {
  const auto found = Found(Slowly(10'000, 50e-6) + Slowly(12'000, 50e-6));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].time_s, 1.0, 1e-9);
  EXPECT_NEAR(found[0].step_m, 100e-6, 1e-9);
}

TEST(ProbeJumps, ThatGoBackSaySo) {
  const auto found = Found(Slowly(10'000, kJumpM) + Slowly(20'000, -kJumpM));
  ASSERT_EQ(found.size(), 2U);
  EXPECT_FALSE(found[0].returns);
  EXPECT_TRUE(found[1].returns);
}

TEST(ProbeJumps, AreNoGlitchThatGoesBack) {
  for (const double wrong_m : {80e-6, 185e-6, -80e-6}) {
    for (const int cycles : {1, 2, 6, 1000}) {
      EXPECT_TRUE(Found({{10'000, wrong_m, 0.0}, {10'000 + cycles, -wrong_m, 0.0}}).empty())
          << wrong_m << ", " << cycles;
    }
  }
}

TEST(ProbeJumps, AreNoGlitchBeforeALoadThatCostsAsMuch) {
  const std::vector<Change> load{{12'000, 0.0, kJumpM * CurrentPerMetre()}};
  const std::vector<Change> glitch{{10'000, kJumpM, 0.0}, {10'010, -kJumpM, 0.0}};
  EXPECT_TRUE(Found(glitch + load).empty());
}

TEST(ProbeJumps, AreFoundSoonAfterAGlitch) {
  const std::vector<Change> glitch{{10'000, kJumpM, 0.0}, {10'010, -kJumpM, 0.0}};
  const auto found = Found(glitch + Slowly(13'000, kJumpM));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].time_s, 1.3, 1e-9);
}

TEST(ProbeJumps, AreNoLoadThatIsCarriedSince) {
  auto changes = Slowly(10'000, kJumpM);
  for (Change& change : changes) change.current_a = -change.current_a;
  EXPECT_TRUE(Found(changes).empty());
}

TEST(ProbeJumps, AreNoStepThatARotorCouldMake) {
  EXPECT_TRUE(Found(Slowly(10'000, 0.09 * Rig().numbers.ClearanceOf(1))).empty());
}

TEST(ProbeJumps, AreNotSoughtWhereTheRotorIsMovedOnPurpose) {
  EXPECT_TRUE(Found(Slowly(10'000, kJumpM), Mode::kLift).empty());
}

TEST(ProbeJumps, AreFoundFromTheSettlingTimeOn) {
  EXPECT_EQ(Found(Slowly(5'100, kJumpM)).size(), 1U);  // 0.5 s of settling
}

TEST(ProbeJumps, ThatPutTheRotorIntoItsTouchdownBearingSaySo) {
  // The law does not bring the reading back, and the bearing carries: the current is far from what
  // the place would cost the magnets.
  const auto found = Found({{10'000, kJumpM, 0.0},
                            {10'020, -10e-6, 0.3},
                            {10'021, -18e-6, 0.0},
                            {10'022, -18e-6, 0.0},
                            {10'023, -18e-6, 0.0},
                            {10'024, -18e-6, 0.0},
                            {10'025, -18e-6, 0.0},
                            {10'026, -18e-6, 0.0},
                            {10'027, -18e-6, 0.0},
                            {10'028, -18e-6, 0.0},
                            {10'029, -18e-6, 0.0},
                            {10'030, -18e-6, 0.0}});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_FALSE(found[0].moved_m.has_value());
}

/// Levitated, then tripped; the probe of nde_x reads `step_m` more from `cycle` to `back` on.
std::vector<ProbeJump> BrokenOff(double step_m, int cycle, int back = 20'000) {
  SyntheticSession session;
  int now = 0;
  session.Append(Mode::kLevitating, 10'100, {.static_a = 0.2}, [&](cycle::CycleRecord& record) {
    if (now >= cycle && now < back) record.in.frame.position_m[kAxis] += step_m;
    ++now;
  });
  session.Append(Mode::kTripped, 100);
  ProbeJumps jumps(Rig(), 1.0, 0.5);
  for (const auto& record : session.records()) jumps.Add(record);
  EXPECT_TRUE(jumps.Found().empty());
  return jumps.BrokenOff();
}

TEST(ProbeJumps, ThatEndTheLevitationAreToldUnjudged) {
  const auto steps = BrokenOff(kJumpM, 10'000);
  ASSERT_EQ(steps.size(), 1U);
  EXPECT_EQ(steps[0].channel, "nde_x");
  EXPECT_NEAR(steps[0].time_s, 1.0, 1e-9);
  EXPECT_NEAR(steps[0].step_m, kJumpM, 1e-12);
  EXPECT_TRUE(BrokenOff(0.05 * kJumpM, 10'000).empty());   // a rotor moves so
  EXPECT_TRUE(BrokenOff(kJumpM, 10'000, 10'010).empty());  // a glitch that was over
  EXPECT_TRUE(BrokenOff(kJumpM, 20'000).empty());          // none
}

}  // namespace
}  // namespace levitas::verdict

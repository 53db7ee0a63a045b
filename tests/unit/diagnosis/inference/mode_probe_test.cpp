// A mode that rings elsewhere than its file says is begun there.

#include "diagnosis/inference/mode_probe.hpp"

#include <gtest/gtest.h>

#include "tests/unit/diagnosis/trajectories.hpp"

namespace levitas::diagnosis {
namespace {

class ModeProbeTest : public ::testing::Test {
 protected:
  [[nodiscard]] std::vector<ModeProbe> Probes(double amplitude_m, double ratio,
                                              double speed_rad_per_s = 0.0) const {
    const double hz = ratio * TheRig().omega_rad_per_s[3] / (2.0 * std::numbers::pi);
    const auto ringing = [&](std::size_t, SamplePoint& m) {
      m.speed_rad_per_s = static_cast<float>(speed_rad_per_s);
      m.innovation_m[1] += static_cast<float>(Sine(amplitude_m, hz, m.time_s));
    };
    return ProbeModes(TheRig(), terms_, hypotheses_, {NoiseRun(3, 20'000, ringing)});
  }

  std::vector<Term> terms_ = EveryTerm();
  std::vector<Hypothesis> hypotheses_ = MakeHypotheses(TheRig(), terms_);
};

TEST_F(ModeProbeTest, BeginsAtTheLineBesideTheModesFrequency) {
  const auto probes = Probes(0.5e-6, 1.1);
  ASSERT_EQ(probes.size(), 1U);
  EXPECT_EQ(hypotheses_[probes[0].hypothesis].place, "mode 2");
  EXPECT_EQ(terms_[probes[0].term].effect, effect::Id::kModalFrequency);
  EXPECT_NEAR(probes[0].theta, 0.1, 0.01);  // lines are 5 Hz apart
}

TEST_F(ModeProbeTest, LeavesAloneWhatDerivativesReach) {
  EXPECT_TRUE(Probes(0.5e-6, 1.005).empty());
}

TEST_F(ModeProbeTest, FindsNothingInNoise) { EXPECT_TRUE(Probes(0.0, 1.1).empty()); }

TEST_F(ModeProbeTest, LooksAtRecordsAtRestWhenThereAreAny) {
  const auto turning = [](std::size_t, SamplePoint& m) {
    m.speed_rad_per_s = 300.0F;
    m.innovation_m[1] += static_cast<float>(
        Sine(1e-6, 1.1 * TheRig().omega_rad_per_s[3] / (2.0 * std::numbers::pi), m.time_s));
  };
  const std::vector<Trajectory> runs{NoiseRun(3, 20'000), NoiseRun(4, 20'000, turning)};
  EXPECT_TRUE(ProbeModes(TheRig(), terms_, hypotheses_, runs).empty());
}

}  // namespace
}  // namespace levitas::diagnosis

// Timing and amplifiers: what each effect does to a step of the command, in closed form.
#include <gtest/gtest.h>

#include <cmath>

#include "common/two_pi.hpp"
#include "tests/loop/effects/effect_rig.hpp"

namespace levitas::plant::test {
namespace {

using effect::Id;

constexpr double kSample_s = 1e-4;
constexpr double kTau_s = 1.0 / (kTwoPi * 720.0);  // amplifier of the rig

PlantCommand Command(double control_a) {
  PlantCommand command;
  command.bias_current_a = 1.0;
  command.control_current_a[0] = control_a;
  return command;
}

/// Coil current of de_x after each of `periods` under a step of `step_a`.
std::vector<double> StepResponse(const effect::EffectConfig& entry, double step_a, int periods) {
  Plant plant(QuietWith(entry), 1);
  std::vector<double> current_a;
  for (int i = 0; i < periods; ++i) {
    plant.Advance(Command(step_a));
    current_a.push_back(plant.state()[plant.layout().coil_current]);
  }
  return current_a;
}

double FirstOrder(double time_s, double tau_s) {
  return time_s > 0.0 ? 1.0 - std::exp(-time_s / tau_s) : 0.0;
}

TEST(ExtraDelay, ShiftsTheCurrentByAnyFractionOfASampleAndChangesItsShapeInNothing) {
  for (const double extra_samples : {0.0, 0.3, 1.0, 2.75}) {
    const auto current_a =
        StepResponse(Entry(Id::kExtraDelay, {extra_samples * kSample_s}), 0.1, 20);
    for (std::size_t i = 0; i < current_a.size(); ++i) {
      const double since_s = (static_cast<double>(i + 1) - 1.0 - extra_samples) * kSample_s;
      EXPECT_NEAR(current_a[i], 0.1 * FirstOrder(since_s, kTau_s), 1e-14) << extra_samples;
    }
  }
}

TEST(DroppedSamples, HoldTheLastCurrentForTheExpectedShareOfTime) {
  constexpr double kProbability = 0.05;
  constexpr int kBurst = 3;
  constexpr int kPeriods = 40'000;
  Plant plant(QuietWith(Entry(Id::kDroppedSamples, {kProbability, kBurst})), 11);
  // Rotor kept at rest; each command is new, so that a held one shows.
  int held = 0;
  double before_a = 0.0;
  for (int i = 0; i < kPeriods; ++i) {
    plant.Advance(Command(i % 2 == 0 ? 0.1 : -0.1));
    for (std::size_t s = 0; s < plant.layout().coil_current; ++s) plant.mutable_state()[s] = 0.0;
    const double now_a = plant.state()[plant.layout().coil_current];
    // With the alternating command acting, the current changes sides; held, it goes on.
    const bool rising = now_a > before_a;
    const bool commanded_rising = (i - 1) % 2 == 0;
    if (i > 0 && rising != commanded_rising) ++held;
    before_a = now_a;
  }
  // In a burst of 3 the first and the third held command differ from the alternating one, the
  // second is the same by chance of the alternation: two of three show. Cycles of a mean free run
  // (1 - p)/p and a burst of 3: share of held periods p L/(1 + p (L - 1)).
  const double share = kProbability * kBurst / (1.0 + kProbability * (kBurst - 1));
  const double shown = share * 2.0 / 3.0;
  // About 1800 bursts: relative standard deviation of their number 1/sqrt(1800) = 2.4 %, times 4.
  EXPECT_NEAR(static_cast<double>(held) / kPeriods, shown, 0.1 * shown);
}

TEST(SampleJitter, ReadsAMotionWithAnErrorOfRateTimesDeviation) {
  constexpr double kDeviation_s = 5e-6;
  constexpr double kRate_m_per_s = 5e-4;  // 0.2 mm in all: half the range of the converter
  Plant plant(QuietWith(Entry(Id::kSampleJitter, {kDeviation_s})), 4);
  PlantCommand off;
  off.amplifiers_enabled = false;
  plant.RestInTouchdown();  // no current, no force
  const auto& rigid = plant.model().rigid();
  for (std::size_t i = 0; i < 2; ++i) {
    plant.mutable_state()[plant.layout().v_x + i] =
        kRate_m_per_s * rigid(static_cast<Eigen::Index>(i), 0);
  }
  for (int i = 0; i < 10; ++i) plant.Advance(off);  // the filter settles: 3 periods of 32 us
  constexpr int kSamples = 4000;
  double square = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    const double error_m = plant.Sample().position_m[0] - plant.SensorOutput()[0];
    square += error_m * error_m;
    plant.Advance(off);
  }
  // Standard deviation of an estimate from N samples: 1/sqrt(2 N) = 1.1 %, times 4.
  EXPECT_NEAR(std::sqrt(square / kSamples) / (kDeviation_s * kRate_m_per_s), 1.0, 0.045);
}

TEST(AmplifierBandwidth, ChangesTheTimeConstantAndNotTheFinalCurrent) {
  const auto current_a = StepResponse(Entry(Id::kAmplifierBandwidth, {300.0}), 0.1, 200);
  for (std::size_t i = 0; i < current_a.size(); ++i) {
    const double since_s = static_cast<double>(i) * kSample_s;
    EXPECT_NEAR(current_a[i], 0.1 * FirstOrder(since_s, 1.0 / (kTwoPi * 300.0)), 1e-14);
  }
  EXPECT_NEAR(current_a.back(), 0.1, 1e-14);
}

TEST(AmplifierSlew, LimitsTheRateOfALargeStepAndLeavesASmallOneAlone) {
  constexpr double kSlew_a_per_s = 150.0;
  const auto large_a = StepResponse(Entry(Id::kAmplifierSlew, {kSlew_a_per_s}), 0.5, 20);
  for (std::size_t i = 1; i < 20; ++i) {
    // Above an error of slew x tau = 33 mA the law asks for more than the limit.
    if (large_a[i] > 0.5 - kSlew_a_per_s * kTau_s) break;
    EXPECT_NEAR(large_a[i] - large_a[i - 1], kSlew_a_per_s * kSample_s, 1e-12);
  }
  const auto small_a = StepResponse(Entry(Id::kAmplifierSlew, {kSlew_a_per_s}), 0.03, 20);
  for (std::size_t i = 0; i < 20; ++i) {
    EXPECT_NEAR(small_a[i], 0.03 * FirstOrder(static_cast<double>(i) * kSample_s, kTau_s), 1e-12);
  }
}

}  // namespace
}  // namespace levitas::plant::test

// Rigs that are a little off, and disturbances outside the vocabulary: each has the size that its
// description says, where it says, and nothing else moves.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "benchmark/accuracy/perturbed_rig.hpp"
#include "benchmark/accuracy/rig_trials.hpp"
#include "benchmark/accuracy/unmodelled_disturbance.hpp"
#include "configuration/rig_file.hpp"
#include "plant_sim/plant/plant_model.hpp"

namespace levitas::accuracy {
namespace {

constexpr double kPeriodS = 1e-4;

configuration::RigFile Rig(const std::string& name) {
  return configuration::LoadRig(configuration::FindConfig(name, "rigs"));
}

Disturbance Drawn(Unmodelled kind, double size, std::uint64_t seed) {
  Random random(seed);
  return {kind, size, 4, kPeriodS, random};
}

TEST(Disturbance, OfNothingAddsNothing) {
  Disturbance none = Drawn(Unmodelled::kNothing, 1.0, 1);
  AxisArray reading_m{1e-6, 2e-6, 3e-6, 4e-6};
  const AxisArray before = reading_m;
  none.Read(0.3, reading_m);
  EXPECT_EQ(reading_m, before);
  EXPECT_EQ(none.Current(0.3, 1.0, 300.0), AxisArray{});
}

TEST(Disturbance, ToneIsASineOfItsFrequencyInOneAxisAwayFromTheMains) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    Disturbance tone = Drawn(Unmodelled::kToneForce, 2.0, seed);
    for (const double line : {100.0, 120.0, 150.0, 180.0}) {
      EXPECT_GE(std::abs(tone.frequency_hz() - line), 4.0) << seed;
    }
    const double quarter_s = 0.25 / tone.frequency_hz();
    AxisArray current_a = tone.Current(quarter_s, 0.0, 0.0);
    EXPECT_NEAR(current_a[tone.axis()], 0.06, 1e-12);  // at the top of the sine
    current_a[tone.axis()] = 0.0;
    EXPECT_EQ(current_a, AxisArray{});
    EXPECT_NEAR(tone.Current(2.0 * quarter_s, 0.0, 0.0)[tone.axis()], 0.0, 1e-12);
  }
}

TEST(Disturbance, WhirlIsACircleBelowHalfTheSpeedAndStopsWithTheRotor) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Disturbance whirl = Drawn(Unmodelled::kSubsynchronous, 1.0, seed);
    const std::size_t x = whirl.axis() - whirl.axis() % 2;
    const auto at = [&](double angle) {
      const AxisArray a = whirl.Current(0.0, angle, 100.0);
      return std::complex<double>(a[x], a[x + 1]);
    };
    EXPECT_NEAR(std::abs(at(0.9)), 0.03, 1e-12);
    // Phase per angle of the rotor: between 0.42 and 0.48, forward.
    const double order = std::arg(at(1.9) / at(0.9));
    EXPECT_GE(order, 0.42);
    EXPECT_LT(order, 0.48);
    EXPECT_EQ(whirl.Current(0.0, 0.9, 0.0), AxisArray{});
  }
}

// The angle of a frame lies within one turn. A whirl that began anew with it would repeat itself
// turn by turn, as a force that is bound to the rotation does.
TEST(Disturbance, WhirlGoesOnWhereTheAngleBeginsANewTurn) {
  Disturbance whirl = Drawn(Unmodelled::kSubsynchronous, 1.0, 3);
  const std::size_t x = whirl.axis() - whirl.axis() % 2;
  std::vector<std::complex<double>> after_turns;
  constexpr int kStepsPerTurn = 60;
  for (int n = 0; n <= 3 * kStepsPerTurn; ++n) {
    const double turns = static_cast<double>(n % kStepsPerTurn) / kStepsPerTurn;
    const AxisArray a = whirl.Current(0.0, 2.0 * std::numbers::pi * turns, 100.0);
    if (n % kStepsPerTurn == 0) after_turns.emplace_back(a[x], a[x + 1]);
  }
  const double a_turn = std::arg(after_turns[1] / after_turns[0]) / (2.0 * std::numbers::pi);
  EXPECT_GE(a_turn, 0.42);
  EXPECT_LT(a_turn, 0.48);
  const std::complex<double> as_far = after_turns[1] / after_turns[0];
  EXPECT_NEAR(std::abs(after_turns[2] / after_turns[1] - as_far), 0.0, 1e-9);
  EXPECT_NEAR(std::abs(after_turns[3] / after_turns[2] - as_far), 0.0, 1e-9);
}

TEST(Disturbance, TurbulenceHasTheRmsOfItsSizeWhateverItsFrequency) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Disturbance turbulence = Drawn(Unmodelled::kTurbulence, 1.0, seed);
    double square = 0.0;
    constexpr int kSamples = 200'000;
    for (int n = 0; n < kSamples; ++n) {
      const double a = turbulence.Current(n * kPeriodS, 0.0, 0.0)[turbulence.axis()];
      square += a * a / kSamples;
    }
    // 20 s of a band of 2 x 0.1 x 70 Hz and more: 280 independent samples, 6 % of the square; four
    // sigma, and a tenth for the step's own damping.
    EXPECT_NEAR(std::sqrt(square), 0.03, 0.03 * 0.2) << turbulence.frequency_hz();
  }
}

TEST(Disturbance, CrosstalkReadsTheOtherBearingInTheSamePlane) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Disturbance crosstalk = Drawn(Unmodelled::kCrosstalk, 1.0, seed);
    const std::size_t other = (crosstalk.axis() + 2) % 4;
    AxisArray reading_m{};
    reading_m[other] = 1e-5;
    crosstalk.Read(0.0, reading_m);
    EXPECT_NEAR(reading_m[crosstalk.axis()], 8e-7, 1e-18);
    EXPECT_EQ(reading_m[other], 1e-5);
  }
}

TEST(Disturbance, AWanderingGainScalesOneReadingBothWays) {
  Disturbance wandering = Drawn(Unmodelled::kWanderingGain, 1.0, 3);
  const auto gain = [&](double time_s) {
    AxisArray reading_m;
    reading_m.fill(1.0);
    wandering.Read(time_s, reading_m);
    return reading_m[wandering.axis()];
  };
  EXPECT_NEAR(gain(0.25 / 1.7), 1.25, 1e-12);
  EXPECT_NEAR(gain(0.75 / 1.7), 0.75, 1e-12);
}

TEST(Disturbance, RepeatsWithItsSeed) {
  for (const Unmodelled kind : {Unmodelled::kToneForce, Unmodelled::kTurbulence}) {
    Disturbance one = Drawn(kind, 1.0, 5);
    Disturbance same = Drawn(kind, 1.0, 5);
    Disturbance other = Drawn(kind, 1.0, 6);
    for (int n = 0; n < 50; ++n) {
      const AxisArray current_a = one.Current(n * kPeriodS, 0.0, 0.0);
      EXPECT_EQ(current_a, same.Current(n * kPeriodS, 0.0, 0.0));
      if (n > 0) {
        EXPECT_NE(current_a, other.Current(n * kPeriodS, 0.0, 0.0));
      }
    }
  }
}

TEST(SpoiledTrain, IsOffByAtMostTwoDeviationsAndAShaftsStiffnessesTogether) {
  const plant::PlantConfig nominal = Rig("geared_rotor_8dof").plant;
  const TrainMismatch off;
  double largest = 0.0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    plant::PlantConfig rig = nominal;
    Random random(seed);
    Spoil(rig, off, random);
    for (std::size_t s = 0; s < rig.shafts.size(); ++s) {
      const rotor::LumpedShaft& now = rig.shafts[s].lumped;
      const rotor::LumpedShaft& file = nominal.shafts[s].lumped;
      const double ratio = now.kll_n_per_m / file.kll_n_per_m;
      EXPECT_NEAR(now.kla_n, ratio * file.kla_n, 1e-9 * std::abs(file.kla_n));
      EXPECT_NEAR(now.kaa_n_m / file.kaa_n_m, ratio, 1e-12);
      EXPECT_EQ(now.mass_kg, file.mass_kg);
      EXPECT_LE(std::abs(ratio - 1.0), 2.0 * off.shaft_stiffness + 1e-12);
      largest = std::max(largest, std::abs(ratio - 1.0));
    }
    const gear::GearPair& pair = rig.gears.front();
    const gear::GearPair& file = nominal.gears.front();
    EXPECT_LE(std::abs(pair.stiffness_n_per_m / file.stiffness_n_per_m - 1.0),
              2.0 * off.mesh_stiffness + 1e-12);
    for (std::size_t h = 0; h < file.transmission_error.size(); ++h) {
      const auto& a = pair.transmission_error[h];
      const auto& b = file.transmission_error[h];
      const double moved_m =
          std::abs(std::polar(a.amplitude_m, a.phase_rad) - std::polar(b.amplitude_m, b.phase_rad));
      EXPECT_LE(moved_m, 2.0 * std::numbers::sqrt2 * off.transmission_error_m + 1e-15);
      EXPECT_EQ(a.order, b.order);
    }
  }
  EXPECT_GT(largest, 1.5 * off.shaft_stiffness);  // 200 draws reach far into the limits
}

TEST(SpoiledTrain, WithoutDeviationsOrWithoutGearsNothingMovesButRounding) {
  plant::PlantConfig rig = Rig("geared_rotor_4dof").plant;
  const gear::GearPair before = rig.gears.front();
  Random random(2);
  Spoil(rig, {0.0, 0.0, 0.0, 0.0, 0.0, 0.0}, random);
  EXPECT_EQ(rig.gears.front().stiffness_n_per_m, before.stiffness_n_per_m);
  EXPECT_NEAR(rig.gears.front().driving.runout_m, before.driving.runout_m, 1e-18);
  Random left(3);
  Random right(3);
  plant::PlantConfig single = Rig("flexible_rotor").plant;
  Spoil(single, {}, left);
  EXPECT_EQ(left.Bits(), right.Bits());  // nothing was drawn
}

/// Nothing is off but what the test sets.
Mismatch Exact() {
  Mismatch off;
  off.current_gain = off.displacement_stiffness = off.amplifier_bandwidth = 0.0;
  off.sensor_gain = off.sensor_bandwidth = off.sensor_offset_m = off.sensor_position_m = 0.0;
  off.sensor_runout_m = off.delay_samples = off.modal_frequency = off.modal_damping = 0.0;
  off.modal_shape = off.rotor_mass = off.gyroscopic_inertia = off.unbalance_kg_m = 0.0;
  off.static_load_n = 0.0;
  return off;
}

plant::PlantParameters Make(const Mismatch& off, std::uint64_t seed) {
  Random random(seed);
  return PerturbedRig(Rig("flexible_rotor").plant, off, {}, random);
}

TEST(PerturbedRig, WithoutDeviationsHasTheModesAndUnbalanceOfTheFile) {
  const plant::PlantParameters made = Make(Exact(), 4);
  const plant::PlantConfig file = Rig("flexible_rotor").plant;
  const auto nominal = plant::Reduce(file).modes;
  for (Eigen::Index i = 2; i < nominal.frequency_rad_per_s.size(); ++i) {
    // Ten modes of the same finite elements instead of eight: the eigensolver's rounding.
    EXPECT_NEAR(made.modes.frequency_rad_per_s[i] / nominal.frequency_rad_per_s[i], 1.0, 1e-6);
    EXPECT_EQ(made.modes.damping_ratio[i], nominal.damping_ratio[i]);
  }
  EXPECT_EQ(made.config.delay_samples, file.delay_samples);
  for (std::size_t i = 0; i < file.unbalance.size(); ++i) {
    EXPECT_NEAR(made.config.unbalance[i].moment_kg_m, file.unbalance[i].moment_kg_m, 1e-15);
  }
}

TEST(PerturbedRig, TransverseInertiaAloneChangesTheTiltAndNeitherMassNorCentre) {
  const auto body = [](const plant::PlantParameters& rig) {
    const Eigen::VectorXd shift = rig.modes.rigid.col(0);
    const Eigen::VectorXd slope = rig.modes.rigid.col(1);
    const double mass = shift.squaredNorm();
    const double centre = shift.dot(slope) / mass;
    return Eigen::Vector3d(mass, centre, (slope - centre * shift).squaredNorm());
  };
  const Eigen::Vector3d file = body(Make(Exact(), 4));
  Mismatch off = Exact();
  off.transverse_inertia = 0.1;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const plant::PlantParameters made = Make(off, seed);
    const Eigen::Vector3d now = body(made);
    EXPECT_NEAR(now[0] / file[0], 1.0, 1e-9);
    EXPECT_NEAR(now[1], file[1], 1e-9);
    EXPECT_NE(now[2], file[2]);
    EXPECT_NEAR(now[2] / file[2], 1.0, 0.2 + 1e-9);  // two standard deviations
    // Mass-normalised still: a force at z accelerates it by 1/m + (z - zc)^2/It.
    for (Eigen::Index n = 0; n < made.modes.shapes.rows(); n += 7) {
      const double arm_m = made.modes.node_z_m[static_cast<std::size_t>(n)] - now[1];
      const double expected = 1.0 / now[0] + arm_m * arm_m / now[2];
      EXPECT_NEAR(made.modes.shapes.row(n).head(2).squaredNorm(), expected, 1e-6 * expected);
    }
  }
}

TEST(RigTrials, ScaleTheEffectsOfARigAndLeaveOthersAtOne) {
  const RigTrials pump = TrialsOf(Rig("turbomolecular_pump"));
  EXPECT_EQ(pump.Factor(effect::Id::kExtraDelay), 0.35);
  EXPECT_EQ(pump.Factor(effect::Id::kBacklash), 1.0);
  const RigTrials geared = TrialsOf(Rig("geared_rotor_4dof"));
  EXPECT_EQ(geared.Factor(effect::Id::kBacklash), 0.1);
  // A rig without numbers of its own is tried like the flexible rotor: all factors 1.
  for (const SizeOnRig& entry : TrialsOf(Rig("ufu_rig")).effects) EXPECT_EQ(entry.factor, 1.0);
}

}  // namespace
}  // namespace levitas::accuracy

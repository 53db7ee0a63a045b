// Mean forces over a period against quadrature; a rig that a diagnosis cannot take is refused.

#include "diagnosis/model/magnet_means.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "common/problem.hpp"
#include "tests/unit/diagnosis/moments.hpp"

namespace levitas::diagnosis {
namespace {

using testing::HasSubstr;

constexpr double kBiasA = 1.0;

double TimeConstant(std::size_t axis) {
  return 1.0 / (2.0 * std::numbers::pi * TheRig().bearing(axis).amplifier.bandwidth_hz);
}

/// A period in which the coil relaxes from `start_a` towards `command_a`, the rotor at rest.
SamplePoint Relaxing(double start_a, double command_a, double q0) {
  SamplePoint m;
  const double decay = std::exp(-TheRig().period_s / TimeConstant(0));
  for (std::size_t a = 0; a < TheRig().axes; ++a) {
    m.coil_start_a[a] = static_cast<float>(start_a);
    m.command_now_a[a] = static_cast<float>(command_a);
    m.coil_end_a[a] = static_cast<float>(command_a + (start_a - command_a) * decay);
  }
  m.q[0] = m.q[TheRig().modes] = static_cast<float>(q0);
  return m;
}

/// Mean over the period of any function of the relaxing current, by Simpson's rule.
double Mean(double start_a, double command_a, const std::function<double(double)>& of) {
  constexpr int kSteps = 200;
  double sum = 0.0;
  for (int n = 0; n <= kSteps; ++n) {
    const double t = TheRig().period_s * n / kSteps;
    const double weight = n == 0 || n == kSteps ? 1.0 : (n % 2 == 1 ? 4.0 : 2.0);
    sum += weight * of(command_a + (start_a - command_a) * std::exp(-t / TimeConstant(0)));
  }
  return sum / (3.0 * kSteps);
}

struct Swing {
  double start_a, command_a, q0;
};

class MagnetMeansTest : public testing::TestWithParam<Swing> {};

TEST_P(MagnetMeansTest, ForceIsThatOfTheMovingCurrentAndNotOfItsMean) {
  const auto [start_a, command_a, q0] = GetParam();
  SamplePoint m = Relaxing(start_a, command_a, q0);
  MagnetMeans means(TheRig());
  means.Fill(kBiasA, {}, m);
  const magnet::Magnet& magnet = TheRig().magnet(0).magnet;
  const double x_m = q0 * TheRig().magnet(0).actuator_shape[0];
  EXPECT_NEAR(static_cast<double>(m.actuator_m[0]), x_m, 1e-12);  // single precision of 1e-5 m
  const double mean_a = Mean(start_a, command_a, [](double i) { return i; });
  EXPECT_NEAR(static_cast<double>(m.coil_mean_a[0]), mean_a, 1e-6);
  const auto force = [&](double i) { return magnet::Force(magnet, kBiasA, i, x_m); };
  const double truth_n = Mean(start_a, command_a, force);
  const double harm_n = std::abs(force(mean_a) - truth_n);
  // The way is not straight but exponential: a sixth of what the spread changes is left of it.
  EXPECT_NEAR(static_cast<double>(m.force_n[0]), truth_n, harm_n / 6.0 + 1e-5);
}

TEST_P(MagnetMeansTest, SlopesAreThoseOfTheMagnetInThatState) {
  const auto [start_a, command_a, q0] = GetParam();
  SamplePoint m = Relaxing(start_a, command_a, q0);
  MagnetMeans means(TheRig());
  means.Fill(kBiasA, {}, m);
  const magnet::Magnet& magnet = TheRig().magnet(0).magnet;
  const double x_m = q0 * TheRig().magnet(0).actuator_shape[0];
  const double s = magnet.gap_m;
  const double k = magnet.force_constant_n_m2_per_a2;
  // F = k [((i0+i)/(s-x))^2 - ((i0-i)/(s+x))^2] by hand.
  const double per_a = Mean(start_a, command_a, [&](double i) {
    return 2.0 * k * ((kBiasA + i) / std::pow(s - x_m, 2) + (kBiasA - i) / std::pow(s + x_m, 2));
  });
  const double per_m = Mean(start_a, command_a, [&](double i) {
    return 2.0 * k *
           (std::pow(kBiasA + i, 2) / std::pow(s - x_m, 3) +
            std::pow(kBiasA - i, 2) / std::pow(s + x_m, 3));
  });
  // One-sided differences of 1e-4 A and 1e-8 m: 1e-4 of the slope; the way that is not straight.
  EXPECT_NEAR(static_cast<double>(m.force_per_a[0]), per_a, 5e-4 * per_a);
  EXPECT_NEAR(static_cast<double>(m.force_per_m[0]), per_m, 2e-3 * per_m);
}

INSTANTIATE_TEST_SUITE_P(Swings, MagnetMeansTest,
                         testing::Values(Swing{0.2, 0.2, 0.0}, Swing{-0.3, 0.5, 0.0},
                                         Swing{0.4, -0.4, 2e-5}, Swing{0.0, 0.6, -3e-5}));

TEST(MagnetMeans, OfAnAddedCurrentIsTheForceWithItMinusThatWithout) {
  MagnetMeans means(TheRig());
  SamplePoint plain = Relaxing(0.3, 0.1, 1e-5);
  means.Fill(kBiasA, {}, plain);
  EXPECT_EQ(means.OfAddedCurrent(1), 0.0);
  Contribution add;
  add.coil_mean_a[1] = 0.05;
  add.coil_end_a[1] = 0.08;
  SamplePoint more = Relaxing(0.3, 0.1, 1e-5);
  means.Fill(kBiasA, add, more);
  // Single precision of forces of some 10 N.
  EXPECT_NEAR(means.OfAddedCurrent(1),
              static_cast<double>(more.force_n[1]) - static_cast<double>(plain.force_n[1]), 2e-3);
  EXPECT_GT(means.OfAddedCurrent(1), 0.0);
  EXPECT_EQ(means.OfAddedCurrent(0), 0.0);
  EXPECT_NEAR(static_cast<double>(more.coil_end_a[1] - plain.coil_end_a[1]), 0.08, 1e-7);
  EXPECT_EQ(more.force_n[0], plain.force_n[0]);
}

std::string Refusal(const configuration::RigFile& rig) {
  try {
    const RigView view(rig.numbers, rig.plant);
  } catch (const BadInput& problem) {
    return problem.what();
  }
  return "accepted";
}

configuration::RigFile Shipped(const std::string& name) {
  return configuration::LoadRig(configuration::FindConfig(name, "rigs"));
}

TEST(RigView, TooManyModesAreRefusedWithTheKeyThatLowersThem) {
  configuration::RigFile rig = Shipped("flexible_rotor");
  rig.plant.rotor.modes_per_plane = kMaxModes;
  EXPECT_EQ(Refusal(rig), "accepted");
  rig.plant.rotor.modes_per_plane = kMaxModes + 1;
  EXPECT_THAT(Refusal(rig), HasSubstr("rig flexible_rotor has 17 modes per plane"));
  EXPECT_THAT(Refusal(rig), HasSubstr("at most 16: lower rotor.modes_per_plane"));
}

TEST(RigView, ShaftsThatTwistAreRefusedWithTheKeyToLeaveOut) {
  EXPECT_EQ(Refusal(Shipped("geared_rotor_8dof")), "accepted");
  EXPECT_THAT(Refusal(Shipped("geared_rotor_12dof")),
              HasSubstr("shafts that twist cannot be diagnosed; leave out `torsion`"));
}

TEST(RigView, WhatComesByChanceIsKnownAndNotForetold) {
  configuration::RigFile rig = Shipped("flexible_rotor");
  effect::EffectConfig lost;
  lost.id = effect::Id::kDroppedSamples;
  lost.values[0] = 0.01;
  effect::EffectConfig gain;
  gain.id = effect::Id::kSensorGain;
  gain.values[0] = 1.1;
  const std::size_t own = rig.plant.effects.size();
  rig.plant.effects.push_back(lost);
  rig.plant.effects.push_back(gain);
  const RigView view(rig.numbers, rig.plant);
  ASSERT_EQ(view.by_chance.size(), 1U);
  EXPECT_EQ(view.by_chance[0].id, effect::Id::kDroppedSamples);
  EXPECT_EQ(view.model->config().effects.size(), own + 1);
}

}  // namespace
}  // namespace levitas::diagnosis

// A coil on a voltage against its equation: in closed form, and integrated in small steps.
#include "plant_sim/amplifier/voltage_coil.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace levitas::amplifier {
namespace {

constexpr VoltageCoil kCoil{1.0, 0.02, 31e-3, 4.5e-3, 0.0};
constexpr double kRounding = 1e-14;

TEST(VoltageCoil, FollowsItsOwnInductanceExponentially) {
  const double gap_m = 10e-3;
  const double tau_s = 31e-3 * std::exp(-10.0 / 4.5);
  EXPECT_NEAR(TimeConstant(kCoil, gap_m), tau_s, kRounding);
  const double expected_a = 1.02 + (0.4 - 1.02) * std::exp(-1e-3 / tau_s);
  EXPECT_NEAR(Follow(kCoil, 0.4, 1.0, true, gap_m, 0.0, 1e-3), expected_a, kRounding);
}

TEST(VoltageCoil, IsSlowerWithTheBallCloser) {
  EXPECT_LT(Follow(kCoil, 0.0, 1.0, true, 5e-3, 0.0, 1e-3),
            Follow(kCoil, 0.0, 1.0, true, 15e-3, 0.0, 1e-3));
}

TEST(VoltageCoil, EndsAtGainTimesCommandPlusOffset) {
  VoltageCoil coil = kCoil;
  coil.steady = 0.9;
  EXPECT_NEAR(Follow(coil, 3.0, 1.0, true, 10e-3, 0.0, 10.0), 0.92, kRounding);
}

TEST(VoltageCoil, InTwoHalfStepsIsTheSameAsInOne) {
  const double half_a = Follow(kCoil, 0.3, 1.5, true, 8e-3, 0.0, 5e-4);
  EXPECT_NEAR(Follow(kCoil, half_a, 1.5, true, 8e-3, 0.0, 5e-4),
              Follow(kCoil, 0.3, 1.5, true, 8e-3, 0.0, 1e-3), kRounding);
}

TEST(VoltageCoil, SwitchedOffFallsToNothingAndNeverBelow) {
  EXPECT_NEAR(Follow(kCoil, 1.0, 1.0, false, 10e-3, 0.0, 10.0), 0.0, kRounding);
  VoltageCoil coil = kCoil;
  coil.offset_a = -0.5;
  EXPECT_EQ(Follow(coil, 0.0, 0.0, true, 10e-3, 0.0, 1.0), 0.0);
}

// d(L i)/dt with L ~ e^(-gap/d): without drive and with tau long against the step, L i stays, so a
// gap that closes by v h lets the current fall by e^(-v h/d).
TEST(VoltageCoil, KeepsItsFluxWhenTheBallMovesAndTheEmfCounts) {
  const VoltageCoil ideal{1.0, 0.0, 1e12, 4.5e-3, 1.0};
  const double closing_m_per_s = -0.2;
  EXPECT_NEAR(Follow(ideal, 1.0, 0.0, true, 0.0, closing_m_per_s, 1e-3),
              std::exp(-0.2 * 1e-3 / 4.5e-3), 1e-9);  // tau is long, not infinite
}

VoltageCoil Complete() {
  VoltageCoil coil{1.1, 0.03, 60e-3, 20e-3, 0.8};
  coil.dead_band_a = 0.09;
  coil.curvature = 0.3;
  coil.full_a = 2.5;
  coil.iron_1_per_a2 = 0.25;
  return coil;
}

TEST(VoltageCoil, DrivesNothingWithinItsDeadBandAndLessBeyondIt) {
  VoltageCoil coil = kCoil;
  coil.dead_band_a = 0.09;
  EXPECT_EQ(Driven(coil, 0.0), 0.0);
  EXPECT_EQ(Driven(coil, 0.09), 0.0);
  EXPECT_NEAR(Driven(coil, 1.0), 0.91, kRounding);
  EXPECT_NEAR(Follow(coil, 3.0, 0.0, true, 10e-3, 0.0, 10.0), 0.02, kRounding)
      << "an idle coil keeps its offset";
}

TEST(VoltageCoil, IsCurvedBetweenNothingAndFullDuty) {
  VoltageCoil coil = kCoil;
  coil.full_a = 2.0;
  coil.curvature = 0.5;
  EXPECT_EQ(Driven(coil, 0.0), 0.0);
  EXPECT_NEAR(Driven(coil, 1.0), 1.25, kRounding);
  EXPECT_NEAR(Driven(coil, 2.0), 2.0, kRounding);
}

TEST(VoltageCoil, HasTheSlopeOfItsDrive) {
  const VoltageCoil coil = Complete();
  for (const double command_a : {0.05, 0.2, 1.2, 2.4}) {
    const double h = 1e-6;
    const double slope = (Driven(coil, command_a + h) - Driven(coil, command_a - h)) / (2.0 * h);
    EXPECT_NEAR(DrivenSlope(coil, command_a), slope, 1e-8) << command_a;
  }
  EXPECT_EQ(DrivenSlope(kCoil, 1.0), 1.0);
}

TEST(VoltageCoil, WithoutDeadBandCurvatureIronAndWarmingIsThePlainLagBitForBit) {
  VoltageCoil coil{1.07, 0.024, 31e-3, 4.5e-3, 0.6};
  coil.full_a = 2.5165;
  for (int n = 0; n < 200; ++n) {
    const double now_a = 0.011 * n;
    const double command_a = 0.0127 * (200 - n);
    const double gap_m = 4e-3 + 7e-5 * n;
    const double rate_m_per_s = 1e-3 * (n - 100);
    const double duration_s = 5e-5;
    const double decay = 1.0 / (coil.time_constant_s * std::exp(-gap_m / coil.decay_m));
    const double rate = decay - coil.motion_emf * rate_m_per_s / coil.decay_m;
    const double turns = rate * duration_s;
    const double drive = (coil.steady * command_a + coil.offset_a) * decay;
    const double plain = now_a * std::exp(-turns) + drive * (-std::expm1(-turns) / rate);
    EXPECT_EQ(Follow(coil, now_a, command_a, true, gap_m, rate_m_per_s, duration_s), plain) << n;
  }
}

/// What the coil and its rotor do: a command, a gap that moves, a resistance that grows.
struct Ride {
  double command_a{}, gap_m{}, gap_rate_m_per_s{}, warming_1_per_s{};
};

// The header's equation by Runge and Kutta's fourth order, 0.5 us a step.
double Integrated(const VoltageCoil& coil, const Ride& ride, double now_a, double duration_s) {
  const double u = std::max(0.0, ride.command_a - coil.dead_band_a) *
                   (1.0 + coil.curvature * (1.0 - ride.command_a / coil.full_a));
  const auto slope = [&](double t, double i) {
    const double gap_m = ride.gap_m + ride.gap_rate_m_per_s * t;
    const double tau =
        coil.time_constant_s * std::exp(-gap_m / coil.decay_m) / (1.0 + coil.iron_1_per_a2 * i * i);
    const double resistance = 1.0 + ride.warming_1_per_s * t;
    return (coil.steady * u + coil.offset_a - resistance * i) / tau +
           coil.motion_emf * i * ride.gap_rate_m_per_s / coil.decay_m;
  };
  const int steps = static_cast<int>(std::lround(duration_s / 0.5e-6));
  const double h = duration_s / steps;
  for (int n = 0; n < steps; ++n) {
    const double t = n * h;
    const double a = slope(t, now_a);
    const double b = slope(t + 0.5 * h, now_a + 0.5 * h * a);
    const double c = slope(t + 0.5 * h, now_a + 0.5 * h * b);
    const double d = slope(t + h, now_a + h * c);
    now_a += h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
  }
  return now_a;
}

double Stepped(const VoltageCoil& coil, const Ride& ride, double now_a, double duration_s,
               int steps) {
  const double h = duration_s / steps;
  for (int n = 0; n < steps; ++n) {
    const double middle_s = (n + 0.5) * h;
    now_a = Follow(coil, now_a, ride.command_a, true, ride.gap_m + ride.gap_rate_m_per_s * middle_s,
                   ride.gap_rate_m_per_s, h, Warmed(ride.warming_1_per_s, middle_s));
  }
  return now_a;
}

TEST(VoltageCoil, IsItsEquationExactlyWhereIronAndRotorStandStill) {
  VoltageCoil coil = Complete();
  coil.iron_1_per_a2 = 0.0;
  for (const double command_a : {0.0, 0.07, 0.5, 1.7, 2.5}) {
    const Ride ride{command_a, 9e-3, 0.0, 0.0};
    EXPECT_NEAR(Stepped(coil, ride, 1.2, 20e-3, 1), Integrated(coil, ride, 1.2, 20e-3), 1e-11);
  }
}

// A moving gap and a warming coil are taken in the middle of a step, second order; iron at its
// start, first order: half the step, half the error.
TEST(VoltageCoil, ComesToItsEquationWithTheStepWhereIronFillsAndTheRotorMoves) {
  const VoltageCoil coil = Complete();
  const Ride ride{2.0, 12e-3, -0.15, 2.0};
  const double exact_a = Integrated(coil, ride, 0.4, 20e-3);
  const double coarse = std::abs(Stepped(coil, ride, 0.4, 20e-3, 100) - exact_a);
  const double fine = std::abs(Stepped(coil, ride, 0.4, 20e-3, 400) - exact_a);
  EXPECT_LT(fine, 5e-4);  // substeps of 50 us, as rig files have them
  EXPECT_NEAR(fine, 0.25 * coarse, 0.05 * coarse);
  VoltageCoil without = coil;
  without.iron_1_per_a2 = 0.0;
  EXPECT_GT(std::abs(Integrated(without, ride, 0.4, 20e-3) - exact_a), 0.02) << "iron matters";
}

TEST(VoltageCoil, WarmsInProportionToTimeAndNeverLosesItsResistance) {
  EXPECT_NEAR(Warmed(2e-3, 50.0), 1.1, kRounding);
  EXPECT_EQ(Warmed(0.0, 1e9), 1.0);
  EXPECT_GT(Warmed(-1.0, 1e9), 0.0);
  EXPECT_NEAR(Follow(kCoil, 0.0, 1.0, true, 10e-3, 0.0, 10.0, 1.1), 1.02 / 1.1, kRounding);
}

}  // namespace
}  // namespace levitas::amplifier

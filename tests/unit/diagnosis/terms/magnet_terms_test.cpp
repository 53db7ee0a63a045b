// Terms of magnets and amplifiers against the laws they stand for.

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "tests/unit/diagnosis/moments.hpp"

namespace levitas::diagnosis {
namespace {

constexpr std::size_t kAxis = 2;  // nde_x
constexpr const char* kChannel = "nde_x";

/// The law of two opposed coils, written out: k ((i0 + i)/(s - x))^2 - k ((i0 - i)/(s + x))^2.
double Law(double plus_a, double minus_a, double x) {
  const auto& magnet = TheRig().magnet(kAxis).magnet;
  return magnet.force_constant_n_m2_per_a2 *
         (std::pow(plus_a / (magnet.gap_m - x), 2) - std::pow(minus_a / (magnet.gap_m + x), 2));
}

class MagnetTermsTest : public ::testing::Test {
 protected:
  [[nodiscard]] double MidCoil() const { return static_cast<double>(moment_.coil_mean_a[kAxis]); }
  [[nodiscard]] double X() const { return static_cast<double>(moment_.actuator_m[kAxis]); }
  [[nodiscard]] double Force(const std::string& effect, const std::string& place, double theta) {
    Term term = Named(terms_, effect, place);
    return Added(term, moment_, theta).force_n[kAxis];
  }

  Random random_{4};
  SamplePoint moment_ = Drawn(random_, 100.0);
  std::vector<Term> terms_ = EveryTerm();
  double bias_a_ = TheRig().bias_a(kAxis);
};

// Single precision of what the model did leaves 1e-6 of the force of one coil.
constexpr double kSingleN = 1e-4;  // [N]

// docs/effects.md: F(ratio ic, x). Away from the centre that is not the ratio of the force: with
// the latter the weight of the rotor left a rest that passed for saturation.
TEST_F(MagnetTermsTest, CurrentGainMakesTheCurrentCountForMore) {
  const double gained = 1.1 * MidCoil();
  const double expected = Law(bias_a_ + gained, bias_a_ - gained, X()) -
                          Law(bias_a_ + MidCoil(), bias_a_ - MidCoil(), X());
  EXPECT_NEAR(Force("current_gain", kChannel, 0.1), expected, kSingleN);
}

TEST_F(MagnetTermsTest, ForceConstantIsAShareOfTheWholeForce) {
  EXPECT_NEAR(Force("force_constant", kChannel, -0.2),
              -0.2 * Law(bias_a_ + MidCoil(), bias_a_ - MidCoil(), X()), kSingleN);
}

TEST_F(MagnetTermsTest, CommandOffsetIsTheForceOfAFurtherCurrent) {
  constexpr double kOffsetA = -0.05;
  const double with = MidCoil() + kOffsetA;
  EXPECT_NEAR(
      Force("command_offset", kChannel, kOffsetA),
      Law(bias_a_ + with, bias_a_ - with, X()) - Law(bias_a_ + MidCoil(), bias_a_ - MidCoil(), X()),
      kSingleN);
}

TEST_F(MagnetTermsTest, MagneticCouplingMakesForceAcrossTheCurrentWithOneSign) {
  Term term = Named(terms_, "magnetic_coupling", "nde");
  const auto added = Added(term, moment_, 0.1);
  const double ki = magnet::ForcePerCurrent(TheRig().magnet(kAxis).magnet, bias_a_);
  const auto coil = [&](std::size_t axis) {
    return static_cast<double>(moment_.coil_mean_a[axis]);
  };
  EXPECT_NEAR(added.force_n[kAxis], 0.1 * ki * coil(kAxis + 1), kSingleN);
  EXPECT_NEAR(added.force_n[kAxis + 1], 0.1 * ki * coil(kAxis), kSingleN);
  EXPECT_EQ(added.force_n[0], 0.0);
}

TEST_F(MagnetTermsTest, DisplacementStiffnessIsTheShareThatIsThereWithoutCurrent) {
  EXPECT_NEAR(Force("displacement_stiffness", kChannel, -0.2), -0.2 * Law(bias_a_, bias_a_, X()),
              kSingleN);
}

TEST_F(MagnetTermsTest, CoilAsymmetryMakesOneCoilStrongerAndTheOtherWeaker) {
  // k_plus/k_minus = (1 + ratio/2)/(1 - ratio/2), their mean as it was.
  const double plus = bias_a_ + MidCoil();
  const double minus = bias_a_ - MidCoil();
  constexpr double kRatio = 0.08;
  const double expected =
      Law(plus * std::sqrt(1.0 + kRatio / 2.0), minus * std::sqrt(1.0 - kRatio / 2.0), X()) -
      Law(plus, minus, X());
  EXPECT_NEAR(Force("coil_asymmetry", kChannel, kRatio), expected, kSingleN);
}

TEST_F(MagnetTermsTest, OfOneAxisLeaveTheOthersAlone) {
  for (const char* effect : {"current_gain", "force_constant", "command_offset",
                             "displacement_stiffness", "coil_asymmetry", "eddy_current"}) {
    Term term = Named(terms_, effect, kChannel);
    const Contribution add = Added(term, moment_, term.scale());
    for (std::size_t a = 0; a < TheRig().axes; ++a) {
      if (a != kAxis) {
        EXPECT_EQ(add.force_n[a], 0.0) << effect;
      }
    }
  }
}

TEST_F(MagnetTermsTest, EddyCurrentLagsCurrentAndDisplacementAsOne) {
  // A displacement x and the current (ks/ki) x that makes its force are the same to the lag.
  const auto& magnet = TheRig().magnet(kAxis).magnet;
  const double a_per_m = bias_a_ / magnet.gap_m;  // ks/ki of the law of the gap squared
  Term of_current = Named(terms_, "eddy_current", kChannel);
  Term of_displacement = Named(terms_, "eddy_current", kChannel);
  Term of_both = Named(terms_, "eddy_current", kChannel);
  const double theta = std::sqrt(50e-6);
  constexpr double kPlaceM = 1e-6;
  SamplePoint m = moment_;
  m.restarted = false;
  for (int n = 0; n < 20; ++n) {
    const auto added = [&](Term& term, double current_a, double x_m) {
      m.coil_mean_a[kAxis] = static_cast<float>(current_a);
      m.actuator_m[kAxis] = static_cast<float>(x_m);
      return Added(term, m, theta).force_n[kAxis];
    };
    const double current_n = added(of_current, a_per_m * kPlaceM, 0.0);
    // The law's curvature: (x/s0) of the force, 0.3 %.
    EXPECT_NEAR(added(of_displacement, 0.0, kPlaceM), current_n, 0.01 * std::abs(current_n));
    EXPECT_NEAR(added(of_both, -a_per_m * kPlaceM, kPlaceM), 0.0, 0.01 * std::abs(current_n));
    EXPECT_LT(current_n, 0.0);  // less than the force without a lag
  }
}

TEST_F(MagnetTermsTest, EddyCurrentOfTheCurrentAloneDoesNotSeeADisplacement) {
  Term term = Named(terms_, "eddy_current", kChannel, kRootTauOfCurrent);
  SamplePoint m = moment_;
  m.restarted = false;
  m.coil_mean_a[kAxis] = 0.0F;
  EXPECT_EQ(Added(term, m, std::sqrt(50e-6)).force_n[kAxis], 0.0);
  m.coil_mean_a[kAxis] = 0.1F;
  EXPECT_LT(Added(term, m, std::sqrt(50e-6)).force_n[kAxis], 0.0);
}

TEST_F(MagnetTermsTest, RotationOfTheAxesTurnsTheForce) {
  Term term = Named(terms_, "axis_rotation", "magnet nde");
  const double theta = 0.02;
  const Contribution add = Added(term, moment_, theta);
  const double fx = static_cast<double>(moment_.force_n[2]);
  const double fy = static_cast<double>(moment_.force_n[3]);
  // Rotation of (fx, fy) by theta to first order; its length then stays to second order.
  EXPECT_NEAR(add.force_n[2], -std::sin(theta) * fy, 1e-3 * std::abs(theta * fy));
  EXPECT_NEAR(add.force_n[3], std::sin(theta) * fx, 1e-3 * std::abs(theta * fx));
  EXPECT_NEAR(std::hypot(fx + add.force_n[2], fy + add.force_n[3]), std::hypot(fx, fy),
              theta * theta * std::hypot(fx, fy));
  EXPECT_EQ(add.force_n[0], 0.0);
}

TEST_F(MagnetTermsTest, SaturationTakesNothingFarBelowTheKneeAndMuchAboveIt) {
  // i/(1 + (i/knee)^4)^(1/4): at the knee 2^(-1/4) of the current is left, a tenth below it all.
  SamplePoint& m = moment_;
  m.actuator_m = {};
  m.coil_start_a = m.coil_end_a = m.coil_mean_a = {};
  const auto set = [&](double current_a) {
    m.coil_start_a[kAxis] = m.coil_end_a[kAxis] = m.coil_mean_a[kAxis] =
        static_cast<float>(current_a);
    m.force_n[kAxis] = static_cast<float>(Law(bias_a_ + current_a, bias_a_ - current_a, 0.0));
  };
  set(bias_a_);  // all of it in one coil, 2 i0 against a knee of 1.7 i0
  const double ratio = 2.0 / 1.7;
  const double left = 1.0 / std::sqrt(1.0 + std::pow(ratio, 4));  // squared current
  EXPECT_NEAR(Force("magnetic_saturation", "knee 1.700 i0, exponent 4.00", 1.0),
              Law(2.0 * bias_a_, 0.0, 0.0) * (left - 1.0), 10.0 * kSingleN);
  set(0.0);
  EXPECT_NEAR(Force("magnetic_saturation", "knee 2.200 i0, exponent 4.00", 1.0), 0.0, kSingleN);
}

TEST_F(MagnetTermsTest, HysteresisOfAFullLoopTakesEnergy) {
  Term term = Named(terms_, "hysteresis", "width 0.03 i0");
  // Work of the force over a cycle of the current, i from sin: positive means taken from the drive.
  double loop = 0.0;
  SamplePoint m = Rest();
  m.force_per_a[kAxis] = 40.0F;
  constexpr int kSteps = 400;
  for (int n = 0; n < 3 * kSteps; ++n) {
    const double phase = 2.0 * std::numbers::pi / kSteps;
    m.coil_start_a[kAxis] = static_cast<float>(0.4 * std::sin(phase * n));
    m.coil_end_a[kAxis] = static_cast<float>(0.4 * std::sin(phase * (n + 1)));
    m.coil_mean_a[kAxis] = 0.5F * (m.coil_start_a[kAxis] + m.coil_end_a[kAxis]);
    const double force = Added(term, m, 1.0).force_n[kAxis];
    if (n < kSteps) continue;  // the virgin curve
    loop += force * static_cast<double>(m.coil_end_a[kAxis] - m.coil_start_a[kAxis]) / 2.0;
  }
  // A branch from -1 towards 1 is z = 1 - 2 exp(-s/2w): 2 A - 4 w of area for s to 2 A, both ways.
  const double width = 0.03 * bias_a_;
  const double expected = -40.0 * width * (4.0 * 0.4 - 8.0 * width);
  EXPECT_NEAR(loop, expected, 0.03 * std::abs(expected));
}

/// Gain of the lagged current over the current at a frequency, from the term's own steps.
std::complex<double> EddyResponse(double tau_s, double hz) {
  Term term = Named(EveryTerm(), "eddy_current", kChannel);
  const double period = TheRig().period_s;
  const double w = 2.0 * std::numbers::pi * hz;
  SamplePoint m = Rest();
  const double bias = TheRig().bias_a(kAxis);
  const double per_a = (Law(bias + 0.1, bias - 0.1, 0.0) - Law(bias, bias, 0.0)) / 0.1;
  std::complex<double> in = 0.0;
  std::complex<double> out = 0.0;
  const int settle = static_cast<int>(std::lround(20.0 / (hz * period)));
  const int count = static_cast<int>(std::lround(40.0 / (hz * period)));
  for (int n = 0; n < settle + count; ++n) {
    const double mid = (n + 0.5) * period;
    const double current = 0.1 * std::cos(w * mid);
    m.coil_start_a[kAxis] = m.coil_end_a[kAxis] = m.coil_mean_a[kAxis] =
        static_cast<float>(current);
    const double lag = Added(term, m, std::sqrt(tau_s)).force_n[kAxis] / per_a;
    if (n < settle) continue;
    const auto turn = std::polar(1.0, -w * mid);
    in += current * turn;
    out += (current + lag) * turn;
  }
  return out / in;
}

TEST(EddyCurrentTerm, HasTheHalfOrderLagOfLaminatedIron) {
  // 1/(1 + sqrt(j w tau)), with w tau from 0.02 to 0.5. The sum of first-order sections at half
  // decades, held over a period, is good to a few hundredths.
  for (const double tau_s : {20e-6, 100e-6, 400e-6}) {
    for (const double hz : {100.0, 200.0}) {
      const double w = 2.0 * std::numbers::pi * hz;
      const std::complex<double> expected =
          1.0 / (1.0 + std::sqrt(std::complex<double>(0.0, w * tau_s)));
      EXPECT_LT(std::abs(EddyResponse(tau_s, hz) - expected), 0.04) << tau_s << " s, " << hz;
    }
  }
}

TEST(EddyCurrentTerm, LeavesASteadyCurrentAlone) {
  Term term = Named(EveryTerm(), "eddy_current", kChannel);
  SamplePoint m = Rest();
  m.force_per_a[kAxis] = 1.0F;
  m.coil_start_a[kAxis] = m.coil_end_a[kAxis] = m.coil_mean_a[kAxis] = 1.0F;
  double lag = -1.0;
  for (int n = 0; n < 20'000; ++n) lag = Added(term, m, std::sqrt(100e-6)).force_n[kAxis];
  // A half-order lag has a tail of sqrt(tau/t): 0.7 % after 2 s.
  EXPECT_NEAR(lag, 0.0, 0.01);
}

TEST(EddyCurrentTerm, ForgetsAtAGapOfTheRecord) {
  Term used = Named(EveryTerm(), "eddy_current", kChannel);
  Term fresh = used;
  SamplePoint m = Rest();
  m.force_per_a[kAxis] = 1.0F;
  m.coil_start_a[kAxis] = m.coil_end_a[kAxis] = m.coil_mean_a[kAxis] = 1.0F;
  for (int n = 0; n < 10; ++n) static_cast<void>(Added(used, m, 0.01));
  m.restarted = true;
  EXPECT_EQ(Added(used, m, 0.01).force_n[kAxis], Added(fresh, m, 0.01).force_n[kAxis]);
}

}  // namespace
}  // namespace levitas::diagnosis

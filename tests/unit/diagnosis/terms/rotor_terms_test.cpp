// Terms of the rotor, of what turns with it and of what acts on it from outside, against their
// laws.

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "plant_sim/rotor/plane_shape.hpp"
#include "tests/unit/diagnosis/moments.hpp"

namespace levitas::diagnosis {
namespace {

constexpr double kSpeedRadPerS = 200.0;  // [rad/s]

/// Modal acceleration of a mode as one complex number, x + j y.
std::complex<double> Modal(const Contribution& add, std::size_t mode) {
  return {add.modal[mode], add.modal[TheRig().modes + mode]};
}

SamplePoint Turning(double angle_rad) {
  SamplePoint m;
  m.Turn(angle_rad, kSpeedRadPerS, TheRig().period_s);
  return m;
}

double SensorHz() { return TheRig().bearing(1).sensor.bandwidth_hz; }
double MidAngle(const SamplePoint& m) {
  return m.angle_rad + 0.5 * TheRig().period_s * kSpeedRadPerS;
}

class RotorTermsTest : public ::testing::Test {
 protected:
  [[nodiscard]] Contribution Of(const std::string& effect, const std::string& place,
                                const std::string& parameter, const SamplePoint& moment,
                                double theta) const {
    Term term = Named(terms_, effect, place, parameter);
    return Added(term, moment, theta);
  }
  std::vector<Term> terms_ = EveryTerm();
  std::size_t modes_ = TheRig().modes;
};

TEST_F(RotorTermsTest, UnbalanceTurnsWithTheShaftAndGrowsWithTheSquareOfSpeed) {
  const auto shape = TheRig().Shape(0.2992);
  for (const double angle : {0.0, 1.0, 4.0}) {
    const SamplePoint m = Turning(angle);
    const Contribution add = Of("unbalance", "z 299.2 mm", "cosine", m, 3e-5);
    for (std::size_t i = 0; i < modes_; ++i) {
      const auto expected =
          std::polar(3e-5 * kSpeedRadPerS * kSpeedRadPerS * shape[i], MidAngle(m));
      EXPECT_LT(std::abs(Modal(add, i) - expected), 1e-6) << i;
    }
  }
}

// The centre of mass is at r e^(j angle): twice differentiated, (j W' - W^2) r e^(j angle), and the
// force on the rotor is the negative of it times the mass.
TEST_F(RotorTermsTest, AnUnbalanceThatIsTurnedFasterPushesAcrossItself) {
  constexpr double kFasterRadPerS2 = 283.0;
  const auto shape = TheRig().Shape(0.2992);
  SamplePoint m = Turning(1.0);
  m.acceleration_rad_per_s2 = static_cast<float>(kFasterRadPerS2);
  const std::complex<double> outward(kSpeedRadPerS * kSpeedRadPerS, -kFasterRadPerS2);
  const Contribution cosine = Of("unbalance", "z 299.2 mm", "cosine", m, 3e-5);
  const Contribution sine = Of("unbalance", "z 299.2 mm", "sine", m, 3e-5);
  for (std::size_t i = 0; i < modes_; ++i) {
    const auto expected = 3e-5 * shape[i] * outward * std::polar(1.0, MidAngle(m));
    EXPECT_LT(std::abs(Modal(cosine, i) - expected), 1e-6) << i;
    EXPECT_LT(std::abs(Modal(sine, i) - expected * std::complex<double>(0.0, 1.0)), 1e-6) << i;
  }
}

TEST_F(RotorTermsTest, TheSinePartIsAQuarterTurnAhead) {
  for (const char* effect : {"unbalance", "shaft_bow"}) {
    const std::string place = effect == std::string("unbalance") ? "z 299.2 mm" : "mode 1";
    const auto cosine = Modal(Of(effect, place, "cosine", Turning(0.7), 1e-5), 2);
    const auto sine = Modal(Of(effect, place, "sine", Turning(0.7), 1e-5), 2);
    EXPECT_LT(std::abs(sine - std::complex<double>(0.0, 1.0) * cosine), 1e-9 * std::abs(cosine))
        << effect;
  }
}

TEST_F(RotorTermsTest, ABowPullsWithTheStiffnessOfItsModeAtAnySpeed) {
  const double w2 = std::pow(TheRig().omega_rad_per_s[2], 2);
  const auto& shapes = TheRig().model->parameters().modes.shapes;
  const double largest = shapes.col(2).cwiseAbs().maxCoeff();
  SamplePoint slow = Turning(0.3);
  const auto fast_pull = Modal(Of("shaft_bow", "mode 1", "cosine", slow, 10e-6), 2);
  // The mode's own deflection has its largest value 10 um.
  EXPECT_NEAR(std::abs(fast_pull), w2 * 10e-6 / largest, 1e-6 * std::abs(fast_pull));
  slow.speed_rad_per_s = 1.0F;
  const auto slow_pull = Modal(Of("shaft_bow", "mode 1", "cosine", slow, 10e-6), 2);
  EXPECT_NEAR(std::abs(slow_pull), std::abs(fast_pull), 1e-9);
}

TEST_F(RotorTermsTest, MisalignmentOfANegativeOrderTurnsBackward) {
  for (const int order : {2, -2, 3, -3}) {
    const std::string place = "order " + std::to_string(order);
    const SamplePoint m = Turning(0.4);
    const auto shape = TheRig().Shape(0.0);
    const auto pull = Modal(Of("misalignment", place, "cosine", m, 0.8), 0);
    EXPECT_LT(std::abs(pull - std::polar(0.8 * shape[0], order * MidAngle(m))), 1e-9) << place;
  }
}

TEST_F(RotorTermsTest, RunoutIsThereAtRestAsWell) {
  SamplePoint still;
  still.Turn(0.9, 0.0, TheRig().period_s);
  EXPECT_NEAR(Of("sensor_runout", "order 1, nde_x", "cosine", still, 4e-6).reading_m[2],
              4e-6 * std::cos(0.9), 1e-12);
  EXPECT_EQ(Of("unbalance", "z 299.2 mm", "cosine", still, 4e-6).modal[0], 0.0);
}

TEST_F(RotorTermsTest, RunoutIsReadAtItsOrderOnItsAxisAlone) {
  const SamplePoint m = Turning(0.9);
  const Contribution cosine = Of("sensor_runout", "order 2, de_y", "cosine", m, 4e-6);
  const Contribution sine = Of("sensor_runout", "order 2, de_y", "sine", m, 4e-6);
  // A first-order sensor: H = 1/(1 + j 2 W lag).
  const double late = 2.0 * kSpeedRadPerS / (2.0 * std::numbers::pi * SensorHz());
  const std::complex<double> seen = std::polar(4e-6, 1.8) / std::complex<double>(1.0, late);
  EXPECT_NEAR(cosine.reading_m[1], seen.real(), 1e-12);
  EXPECT_NEAR(sine.reading_m[1], seen.imag(), 1e-12);
  for (const std::size_t a : {0U, 2U, 3U}) EXPECT_EQ(cosine.reading_m[a], 0.0);
  EXPECT_FALSE(cosine.has_modal);
}

TEST_F(RotorTermsTest, AModeOfAnotherFrequencyHasAnotherStiffness) {
  SamplePoint m = Rest();
  m.q[3] = 2e-5F;
  m.q[modes_ + 3] = -1e-5F;
  const double w = TheRig().omega_rad_per_s[3];
  const auto pull = Modal(Of("modal_frequency", "mode 2", "ratio", m, 0.01), 3);
  const double missing = std::pow(1.01 * w, 2) - w * w;
  EXPECT_NEAR(pull.real(), -missing * static_cast<double>(m.q[3]), 1e-9 * missing);
  EXPECT_NEAR(pull.imag(), -missing * static_cast<double>(m.q[modes_ + 3]), 1e-9 * missing);
}

TEST_F(RotorTermsTest, AModeOfMoreDampingLosesMoreEnergy) {
  SamplePoint m = Rest();
  m.v[2] = 3e-3F;
  const double w = TheRig().omega_rad_per_s[2];
  const double z = TheRig().damping_ratio[2];
  const auto pull = Modal(Of("modal_damping", "mode 1", "ratio", m, 0.5), 2);
  EXPECT_NEAR(pull.real(), -2.0 * (0.5 * z) * w * 3e-3, 1e-6 * w * 3e-3);
  EXPECT_LT(pull.real() * static_cast<double>(m.v[2]), 0.0);
}

TEST_F(RotorTermsTest, AHeavierRotorYieldsLessToTheSameForceAsARigidBody) {
  SamplePoint m = Rest();
  for (std::size_t a = 0; a < TheRig().axes; ++a) m.force_n[a] = 10.0F;
  const Contribution add = Of("rotor_mass", "rotor", "ratio", m, 0.1);
  double rigid = 0.0;
  for (std::size_t b = 0; b < 2; ++b) rigid += TheRig().magnet(2 * b).actuator_shape[0] * 10.0;
  // a = F/m, so m -> 1.1 m takes 1 - 1/1.1 of it.
  EXPECT_NEAR(Modal(add, 0).real(), -(1.0 - 1.0 / 1.1) * rigid, 1e-6 * std::abs(rigid));
  for (std::size_t i = 2; i < modes_; ++i) EXPECT_EQ(Modal(add, i), std::complex<double>(0.0));
}

TEST_F(RotorTermsTest, GyroscopicForcesDoNoWork) {
  Random random(3);
  const SamplePoint m = Drawn(random, kSpeedRadPerS);
  const Contribution add = Of("gyroscopic_inertia", "rotor", "ratio", m, 0.2);
  double work = 0.0;
  double size = 0.0;
  for (std::size_t i = 0; i < 2 * modes_; ++i) {
    work += add.modal[i] * static_cast<double>(m.v[i]);
    size += std::abs(add.modal[i] * static_cast<double>(m.v[i]));
  }
  EXPECT_GT(size, 0.0);
  EXPECT_NEAR(work, 0.0, 1e-6 * size);
}

/// Power that a term gives to a forward whirl of the bending modes at `whirl_rad_per_s`.
double PowerInForwardWhirl(Term term, double whirl_rad_per_s) {
  double power = 0.0;
  for (int n = 0; n < 24; ++n) {
    SamplePoint m = Turning(0.0);
    const double phase = 2.0 * std::numbers::pi * n / 24.0;
    const std::size_t modes = TheRig().modes;
    m.q[2] = static_cast<float>(1e-5 * std::cos(phase));
    m.q[modes + 2] = static_cast<float>(1e-5 * std::sin(phase));
    m.v[2] = static_cast<float>(-1e-5 * whirl_rad_per_s * std::sin(phase));
    m.v[modes + 2] = static_cast<float>(1e-5 * whirl_rad_per_s * std::cos(phase));
    const Contribution add = Added(term, m, term.scale());
    power += add.modal[2] * static_cast<double>(m.v[2]) +
             add.modal[modes + 2] * static_cast<double>(m.v[modes + 2]);
  }
  return power;
}

// Damping that turns with the shaft brakes a whirl faster than the shaft and drives a slower one
// (Kimball 1924).
TEST_F(RotorTermsTest, InternalDampingDrivesAForwardWhirlBelowTheSpeedOfTheShaft) {
  const Term term = Named(terms_, "internal_damping", "z 299.2 mm");
  EXPECT_GT(PowerInForwardWhirl(term, 0.5 * kSpeedRadPerS), 0.0);
  EXPECT_LT(PowerInForwardWhirl(term, 2.0 * kSpeedRadPerS), 0.0);
  EXPECT_NEAR(PowerInForwardWhirl(term, kSpeedRadPerS), 0.0,
              1e-3 * PowerInForwardWhirl(term, 0.5 * kSpeedRadPerS));
}

// f = kq [-y, x]: along with the forward whirl, which a positive kq drives (Alford 1965).
TEST_F(RotorTermsTest, CrossCouplingWorksOnTheWhirlAndDirectStiffnessDoesNot) {
  const double coupled =
      PowerInForwardWhirl(Named(terms_, "cross_coupled_stiffness", "z 299.2 mm"), 300.0);
  EXPECT_GT(coupled, 0.0);
  const Term direct = Named(terms_, "coupling_stiffness", "z 0.0 mm", "direct");
  EXPECT_NEAR(PowerInForwardWhirl(direct, 300.0), 0.0, 1e-4 * std::abs(coupled));
}

TEST_F(RotorTermsTest, AnisotropyIsSoftInTheDirectionThatTurnsWithTheShaft) {
  // Deflected along the cosine direction the stiffness is larger by the ratio, across it smaller.
  for (const double angle : {0.0, 0.6}) {
    SamplePoint m = Turning(angle);
    const auto along = std::polar(1e-5, MidAngle(m));
    m.q[2] = static_cast<float>(along.real());
    m.q[modes_ + 2] = static_cast<float>(along.imag());
    const double w2 = std::pow(TheRig().omega_rad_per_s[2], 2);
    const auto pull = Modal(Of("shaft_anisotropy", "rotor", "cosine", m, 0.1), 2);
    EXPECT_LT(std::abs(pull + 0.1 * w2 * along), 1e-5 * w2 * std::abs(along));
  }
}

TEST_F(RotorTermsTest, ACrackIsOpenBelowClosedAboveAndSoftensAcrossItselfAlone) {
  constexpr double kDirection = 0.5 * std::numbers::pi;  // of the crack at angle zero
  const std::complex<double> down{TheRig().model->gravity_direction_x(),
                                  TheRig().model->gravity_direction_y()};
  // The angle at the sample for which the crack points somewhere in the middle of the period.
  const auto pointing = [&](double direction_rad, std::complex<double> sag) {
    SamplePoint m = Turning(direction_rad - kDirection - 0.5 * TheRig().period_s * kSpeedRadPerS);
    m.q[2] = static_cast<float>(sag.real());
    m.q[modes_ + 2] = static_cast<float>(sag.imag());
    return Modal(Of("breathing_crack", "z 228.6 mm, direction 90.0 deg", "softening", m, 0.05), 2);
  };
  const double below = std::arg(down);
  const std::complex<double> sag = 1e-5 * down;
  const double w2 = std::pow(TheRig().omega_rad_per_s[2], 2);
  // R of effect/crack.hpp over that of the first bending mode alone. The curvature here is at the
  // plane, that of the term between middles of elements: they differ by less than 1 in 1000.
  const auto bent = rotor::CurvatureAt(TheRig().model->parameters().modes, 228.6e-3);
  double residual = 0.0;
  for (std::size_t i = 2; i < modes_; ++i)
    residual += std::pow(bent[i] / bent[2], 2) * w2 / std::pow(TheRig().omega_rad_per_s[i], 2);
  const auto gone = [&](double opened) { return opened / (1.0 + opened * residual); };
  // Open: a twentieth of the stiffness is gone along the sag, less what the modes yield of
  // themselves, and none across it.
  EXPECT_LT(std::abs(pointing(below, sag) - gone(0.05) * w2 * sag), 1e-3 * w2 * std::abs(sag));
  const std::complex<double> quarter{0.0, 1.0};
  EXPECT_LT(std::abs(pointing(below, quarter * sag)), 1e-6 * w2 * std::abs(sag));
  // Closed: nothing. To the side: half open, and nothing of a sag along the crack's edge.
  EXPECT_LT(std::abs(pointing(below + std::numbers::pi, sag)), 1e-6 * w2 * std::abs(sag));
  EXPECT_LT(
      std::abs(pointing(below + kDirection, quarter * sag) - gone(0.025) * w2 * quarter * sag),
      1e-3 * w2 * std::abs(sag));
}

TEST_F(RotorTermsTest, AStaticLoadIsAForceOnItsAxis) {
  const Contribution add = Of("static_load", "nde_y", "force_n", Rest(), 2.5);
  EXPECT_EQ(add.force_n[3], 2.5);
  EXPECT_EQ(add.force_n[0], 0.0);
}

TEST_F(RotorTermsTest, ARubPushesInwardsBeyondItsClearanceAndBrakesTheShaftsSurface) {
  // 50 um is the largest orbit the terms were made for: clearances of up to 40 um.
  SamplePoint m = Turning(0.0);
  m.actuator_m[0] = 27e-6F;
  m.actuator_m[1] = 36e-6F;  // 45 um out
  const Contribution add =
      Of("touchdown_rub", "de, clearance 40.00 um, friction 0.100", "stiffness_n_per_m", m, 1e6);
  const std::complex<double> force(add.force_n[0], add.force_n[1]);
  const std::complex<double> outwards(0.6, 0.8);
  const auto parts = force * std::conj(outwards);
  EXPECT_NEAR(parts.real(), -5.0, 1e-3);  // 5 um into 1e6 N/m
  EXPECT_NEAR(parts.imag(), -0.5, 1e-3);  // friction 0.1 against a counter-clockwise surface
  m.actuator_m[0] = 18e-6F;
  m.actuator_m[1] = 24e-6F;
  const Contribution inside =
      Of("touchdown_rub", "de, clearance 40.00 um, friction 0.100", "stiffness_n_per_m", m, 1e6);
  EXPECT_EQ(inside.force_n[0], 0.0);
  EXPECT_EQ(inside.force_n[1], 0.0);
}

TEST_F(RotorTermsTest, ASupportResonatesAtItsFrequency) {
  // Amplitude of the housing under a force at its resonance: F/(2 z m w^2), z = 0.02.
  Term term = Named(terms_, "support_mode", "nde, 90.0 Hz, damping 0.0200");
  const double w = 2.0 * std::numbers::pi * 90.0;
  double largest = 0.0;
  for (int n = 0; n < 40'000; ++n) {
    SamplePoint m = Rest();
    m.force_n[2] = static_cast<float>(std::cos(w * n * TheRig().period_s));
    const double moved = -Added(term, m, 1.0).reading_m[2];
    if (n > 30'000) largest = std::max(largest, std::abs(moved));
  }
  const double expected = 1.0 / (2.0 * 0.02 * w * w);
  EXPECT_NEAR(largest, expected, 0.03 * expected);
}

TEST_F(RotorTermsTest, ASupportUnderAConstantForceRestsWhereItsSpringHoldsIt) {
  Term term = Named(terms_, "support_mode", "nde, 90.0 Hz, damping 0.0200");
  const double w = 2.0 * std::numbers::pi * 90.0;
  for (int n = 0; n < 3'000; ++n) {
    SamplePoint m = Rest();
    m.restarted = n == 0;
    m.force_n[2] = 8.0F;
    // From zero it would swing between nothing and twice this.
    EXPECT_NEAR(-Added(term, m, 0.5).reading_m[2], -0.5 * 8.0 / (w * w), 1e-12) << n;
  }
}

TEST_F(RotorTermsTest, ARubsDampingOpposesTheRadialVelocityAlone) {
  SamplePoint m = Turning(0.0);
  m.actuator_m[0] = 45e-6F;
  m.actuator_m[1] = 0.0F;
  const auto& shape = TheRig().magnet(0).actuator_shape;
  m.v[0] = static_cast<float>(2e-3 / shape[0]);               // outwards at 2 mm/s
  m.v[TheRig().modes] = static_cast<float>(5e-3 / shape[0]);  // and along the ring
  const Contribution add =
      Of("touchdown_rub", "de, clearance 40.00 um, friction 0.100", "damping_n_s_per_m", m, 100.0);
  EXPECT_NEAR(add.force_n[0], -0.2, 1e-6);
  EXPECT_NEAR(add.force_n[1], -0.02, 1e-6);  // friction of the normal force
}

}  // namespace
}  // namespace levitas::diagnosis

// The contact law over random places, velocities and bearings: energy, cone, symmetry, impact.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/random.hpp"
#include "plant_sim/support/touchdown.hpp"

namespace levitas::support {
namespace {

constexpr int kDraws = 20'000;

struct Case {
  Touchdown bearing;
  double x_m, y_m, vx_m_per_s, vy_m_per_s, speed_rad_per_s;

  [[nodiscard]] Contact Force() const {
    return Push(bearing, x_m, y_m, vx_m_per_s, vy_m_per_s, speed_rad_per_s);
  }
  [[nodiscard]] double RadiusM() const { return std::hypot(x_m, y_m); }
  [[nodiscard]] double OutwardMPerS() const {
    return (x_m * vx_m_per_s + y_m * vy_m_per_s) / RadiusM();
  }
  [[nodiscard]] double SlidingMPerS() const {
    return (x_m * vy_m_per_s - y_m * vx_m_per_s) / RadiusM() +
           speed_rad_per_s * bearing.journal_radius_m;
  }
  [[nodiscard]] double TangentialN() const {
    const Contact c = Force();
    return (x_m * c.y_n - y_m * c.x_n) / RadiusM();
  }
  [[nodiscard]] double RadialN() const {
    const Contact c = Force();
    return (x_m * c.x_n + y_m * c.y_n) / RadiusM();
  }
};

// Penetrations up to 50 um, velocities to 0.5 m/s, both senses of rotation, mu up to 0.6.
Case Draw(Random& random) {
  const auto between = [&random](double a, double b) { return a + (b - a) * random.Uniform(); };
  Case c{};
  c.bearing = {between(50e-6, 300e-6), std::pow(10.0, between(6.0, 8.5)), between(0.0, 5000.0),
               between(0.0, 0.6), between(0.005, 0.03)};
  const double angle_rad = between(0.0, 2.0 * std::numbers::pi);
  const double radius_m = c.bearing.clearance_m + between(1e-9, 50e-6);
  c.x_m = radius_m * std::cos(angle_rad);
  c.y_m = radius_m * std::sin(angle_rad);
  c.vx_m_per_s = between(-0.5, 0.5);
  c.vy_m_per_s = between(-0.5, 0.5);
  c.speed_rad_per_s = between(-800.0, 800.0);
  return c;
}

TEST(TouchdownLaw, NeverCreatesEnergy) {
  // Power into the journal and into the shaft's rotation, plus the growth of the spring's energy:
  // what is missing was turned into heat, and heat is never negative.
  Random random(1);
  for (int i = 0; i < kDraws; ++i) {
    const Case c = Draw(random);
    const Contact f = c.Force();
    const double into_journal = f.x_n * c.vx_m_per_s + f.y_n * c.vy_m_per_s;
    const double into_rotation = c.TangentialN() * c.speed_rad_per_s * c.bearing.journal_radius_m;
    const double into_spring =
        c.bearing.stiffness_n_per_m * (c.RadiusM() - c.bearing.clearance_m) * c.OutwardMPerS();
    const double scale = std::abs(into_journal) + std::abs(into_rotation) + std::abs(into_spring);
    // Rounding; radius minus clearance loses four digits.
    EXPECT_LE(into_journal + into_rotation + into_spring, 1e-10 * scale) << i;
  }
}

TEST(TouchdownLaw, StaysInCoulombsConeAndOpposesTheSliding) {
  Random random(2);
  for (int i = 0; i < kDraws; ++i) {
    const Case c = Draw(random);
    const double normal_n = c.Force().normal_n;
    EXPECT_NEAR(c.RadialN(), -normal_n, 1e-12 * normal_n) << i;  // rounding
    EXPECT_LE(std::abs(c.TangentialN()), c.bearing.friction * normal_n * (1.0 + 1e-12)) << i;
    EXPECT_LE(c.TangentialN() * c.SlidingMPerS(), 1e-12 * normal_n) << i;
  }
}

TEST(TouchdownLaw, ReachesTheEdgeOfTheConeOnceItSlidesTenTimesTheSmoothingSpeed) {
  Random random(3);
  int sliding = 0;
  for (int i = 0; i < kDraws; ++i) {
    const Case c = Draw(random);
    if (std::abs(c.SlidingMPerS()) < 10.0 * kSmoothingMPerS || c.Force().normal_n == 0.0) continue;
    ++sliding;
    // 1/sqrt(1 + 0.1^2) = 0.995
    EXPECT_GE(std::abs(c.TangentialN()), 0.995 * c.bearing.friction * c.Force().normal_n) << i;
  }
  EXPECT_GT(sliding, kDraws / 3);  // the condition was met often enough to mean something
}

TEST(TouchdownLaw, TurnsWithTheBearing) {
  Random random(4);
  for (int i = 0; i < kDraws; ++i) {
    const Case c = Draw(random);
    const double angle_rad = 2.0 * std::numbers::pi * random.Uniform();
    const double cosine = std::cos(angle_rad);
    const double sine = std::sin(angle_rad);
    Case turned = c;
    turned.x_m = cosine * c.x_m - sine * c.y_m;
    turned.y_m = sine * c.x_m + cosine * c.y_m;
    turned.vx_m_per_s = cosine * c.vx_m_per_s - sine * c.vy_m_per_s;
    turned.vy_m_per_s = sine * c.vx_m_per_s + cosine * c.vy_m_per_s;
    const Contact f = c.Force();
    const Contact g = turned.Force();
    // Rounding of the radius (1e-19 m) at up to 3e8 N/m, and of the velocity at 5000 N s/m.
    const double tolerance_n = 1e-9 + 1e-11 * f.normal_n;
    EXPECT_NEAR(g.x_n, cosine * f.x_n - sine * f.y_n, tolerance_n) << i;
    EXPECT_NEAR(g.y_n, sine * f.x_n + cosine * f.y_n, tolerance_n) << i;
  }
}

TEST(TouchdownLaw, IsItsOwnMirrorImageWhenTheRotationIsMirroredToo) {
  Random random(5);
  for (int i = 0; i < kDraws; ++i) {
    const Case c = Draw(random);
    Case mirrored = c;
    mirrored.y_m = -c.y_m;
    mirrored.vy_m_per_s = -c.vy_m_per_s;
    mirrored.speed_rad_per_s = -c.speed_rad_per_s;
    EXPECT_EQ(mirrored.Force().x_n, c.Force().x_n);  // the same operations with other signs
    EXPECT_EQ(mirrored.Force().y_n, -c.Force().y_n);
    EXPECT_EQ(mirrored.Force().normal_n, c.Force().normal_n);
  }
}

TEST(TouchdownLaw, PushesHarderTheDeeperTheJournalIsAndTheFasterItComes) {
  Random random(6);
  for (int i = 0; i < kDraws; ++i) {
    const Case c = Draw(random);
    Case deeper = c;
    deeper.x_m *= 1.01;
    deeper.y_m *= 1.01;
    Case faster = c;
    faster.vx_m_per_s += 0.1 * c.x_m / c.RadiusM();
    faster.vy_m_per_s += 0.1 * c.y_m / c.RadiusM();
    EXPECT_GE(deeper.Force().normal_n, c.Force().normal_n) << i;
    EXPECT_GE(faster.Force().normal_n, c.Force().normal_n) << i;
  }
}

struct Impact {
  double restitution{};
  double largest_n{};
  double duration_s{};  ///< with a force
};

// A free mass runs straight into the bearing at 0.1 m/s and comes out again.
Impact Strike(double mass_kg, double damping_n_s_per_m) {
  const Touchdown bearing{190e-6, 1e7, damping_n_s_per_m, 0.0, 0.01};
  constexpr double kStep_s = 2e-8;
  double x_m = -190e-6;
  double v_m_per_s = -0.1;
  Impact impact;
  do {
    // Midpoint rule: second order.
    const auto force_n = [&](double x, double v) {
      return Touches(bearing, x, 0.0) ? Push(bearing, x, 0.0, v, 0.0, 0.0).x_n : 0.0;
    };
    const double half_x_m = x_m + 0.5 * kStep_s * v_m_per_s;
    const double half_v_m_per_s = v_m_per_s + 0.5 * kStep_s * force_n(x_m, v_m_per_s) / mass_kg;
    const double f_n = force_n(half_x_m, half_v_m_per_s);
    x_m += kStep_s * half_v_m_per_s;
    v_m_per_s += kStep_s * f_n / mass_kg;
    impact.largest_n = std::max(impact.largest_n, f_n);
    if (f_n > 0.0) impact.duration_s += kStep_s;
  } while (x_m < -190e-6);
  impact.restitution = v_m_per_s / 0.1;
  return impact;
}

TEST(TouchdownImpact, OfAnUndampedBearingIsHalfAPeriodOfTheSpring) {
  for (const double mass_kg : {0.5, 2.0}) {
    const Impact impact = Strike(mass_kg, 0.0);
    const double w = std::sqrt(1e7 / mass_kg);
    // Midpoint rule of step h: (w h)^2 = 1e-8 per unit; the duration counts whole steps.
    EXPECT_NEAR(impact.restitution, 1.0, 1e-5);
    EXPECT_NEAR(impact.largest_n, 0.1 * w * mass_kg, 1e-4 * impact.largest_n);
    EXPECT_NEAR(impact.duration_s, std::numbers::pi / w, 1e-7);
  }
}

TEST(TouchdownImpact, LosesEnergyAsTheDashpotThatCannotPull) {
  // Schwager and Poeschel (2007): the contact ends when the force, not the penetration, is zero:
  // e = exp(-(b/w) (pi - atan(2 b w/(w^2 - b^2)))), b = d/(2 m), w^2 = k/m - b^2, for b < w.
  for (const double damping_n_s_per_m : {200.0, 1000.0, 2500.0}) {
    const double b = damping_n_s_per_m / 2.0;  // 1 kg
    const double w = std::sqrt(1e7 - b * b);
    ASSERT_LT(b, w);
    const double expected =
        std::exp(-b / w * (std::numbers::pi - std::atan(2.0 * b * w / (w * w - b * b))));
    // The force starts with a jump of d v: one step of it, h b = 3e-5.
    EXPECT_NEAR(Strike(1.0, damping_n_s_per_m).restitution, expected, 1e-4) << damping_n_s_per_m;
  }
}

TEST(TouchdownLaw, MakesNoForceOfAStateThatIsNoNumber) {
  const Touchdown bearing{190e-6, 1e7, 2000.0, 0.2, 0.012};
  // A place that is no number touches nothing; the journal's own state already shows it.
  EXPECT_FALSE(Touches(bearing, std::nan(""), 0.0));
  EXPECT_FALSE(Touches(bearing, 0.0, std::nan("")));
  EXPECT_TRUE(Touches(bearing, INFINITY, 0.0));
  // A velocity that is no number gives no force rather than a force that is none.
  const Contact c = Push(bearing, 200e-6, 0.0, std::nan(""), 0.0, 0.0);
  EXPECT_EQ(c.normal_n, 0.0);
  EXPECT_EQ(c.x_n, 0.0);
}

}  // namespace
}  // namespace levitas::support

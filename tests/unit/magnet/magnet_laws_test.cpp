// The magnet against energy, its geometry and its own linear form, over random working points.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/random.hpp"
#include "plant_sim/magnet/magnet.hpp"

namespace levitas::magnet {
namespace {

constexpr int kDraws = 5'000;

struct Point {
  Magnet magnet;
  double bias_a, control_a, x_m;
};

// Gaps of 0.2 to 1 mm, both coils within their limits, up to 80 % of the gap used up.
Point Draw(Random& random) {
  const auto between = [&random](double a, double b) { return a + (b - a) * random.Uniform(); };
  Point p{};
  p.magnet = {std::pow(10.0, between(-7.0, -4.0)), between(0.2e-3, 1e-3), between(2.0, 10.0)};
  p.bias_a = p.magnet.max_coil_current_a * between(0.05, 0.5);
  p.control_a = p.bias_a * between(-1.0, 1.0);
  p.x_m = p.magnet.gap_m * between(-0.8, 0.8);
  return p;
}

double Force(const Point& p) { return Force(p.magnet, p.bias_a, p.control_a, p.x_m); }

// W(x) = k [ i+^2/(s0-x) + i-^2/(s0+x) ], whose slope at constant currents is the force.
double CoEnergy(const Point& p, double x_m) {
  const double towards = p.bias_a + p.control_a;
  const double away = p.bias_a - p.control_a;
  return p.magnet.force_constant_n_m2_per_a2 *
         (towards * towards / (p.magnet.gap_m - x_m) + away * away / (p.magnet.gap_m + x_m));
}

TEST(MagnetForce, DoesTheWorkThatTheCoEnergyOfTheGapsGives) {
  Random random(11);
  for (int i = 0; i < 200; ++i) {
    Point p = Draw(random);
    const double from_m = p.x_m;
    const double to_m = 0.8 * p.magnet.gap_m * (2.0 * random.Uniform() - 1.0);
    const double change = CoEnergy(p, to_m) - CoEnergy(p, from_m);
    constexpr int kPieces = 2000;  // Simpson
    double work = 0.0;
    for (int piece = 0; piece <= kPieces; ++piece) {
      p.x_m = from_m + (to_m - from_m) * piece / kPieces;
      const double weight = piece == 0 || piece == kPieces ? 1.0 : piece % 2 == 1 ? 4.0 : 2.0;
      work += weight * Force(p) * (to_m - from_m) / (3.0 * kPieces);
    }
    // Simpson's h^4 at 0.2 of the gap: (0.0008/0.2)^4 x 5!/180 = 2e-10 of the largest energy.
    const double scale = std::max(CoEnergy(p, to_m), CoEnergy(p, from_m));
    EXPECT_NEAR(work, change, 1e-8 * scale) << i;
  }
}

TEST(MagnetForce, GrowsWithTheCurrentAndWithTheWayTowardsTheCoil) {
  Random random(12);
  for (int i = 0; i < kDraws; ++i) {
    const Point p = Draw(random);
    Point stronger = p;
    stronger.control_a += 0.01 * p.bias_a;
    Point nearer = p;
    nearer.x_m += 0.01 * p.magnet.gap_m;
    EXPECT_GT(Force(stronger), Force(p)) << i;
    EXPECT_GT(Force(nearer), Force(p)) << i;
  }
}

TEST(MagnetForce, IsExactlyLinearInTheCurrentWhenCentred) {
  // At x = 0 the squares of the differential driving cancel: that is what the bias is for.
  Random random(13);
  for (int i = 0; i < kDraws; ++i) {
    Point p = Draw(random);
    p.x_m = 0.0;
    const double linear_n = ForcePerCurrent(p.magnet, p.bias_a) * p.control_a;
    // The rounding of the coil currents themselves, of which the force is the difference.
    EXPECT_NEAR(Force(p), linear_n, 1e-15 * 4.0 * ForcePerCurrent(p.magnet, p.bias_a) * p.bias_a);
  }
}

TEST(MagnetForce, ExceedsTheLinearStiffnessByTheClosedFormOfTheGap) {
  // Without control current F = ks x/(1 - (x/s0)^2)^2.
  Random random(14);
  for (int i = 0; i < kDraws; ++i) {
    Point p = Draw(random);
    p.control_a = 0.0;
    const double ratio = p.x_m / p.magnet.gap_m;
    const double expected =
        NegativeStiffness(p.magnet, p.bias_a) * p.x_m / std::pow(1.0 - ratio * ratio, 2);
    EXPECT_NEAR(Force(p), expected, 1e-11 * std::abs(expected)) << i;  // rounding
  }
}

TEST(MagnetForce, DependsOnlyOnTheRatioOfCurrentToGap) {
  // Twice the gap, displacement and current: the same flux, the same force.
  Random random(15);
  for (int i = 0; i < kDraws; ++i) {
    const Point p = Draw(random);
    Point large = p;
    large.magnet.gap_m *= 2.0;
    large.magnet.max_coil_current_a *= 2.0;
    large.bias_a *= 2.0;
    large.control_a *= 2.0;
    large.x_m *= 2.0;
    EXPECT_NEAR(Force(large), Force(p), 1e-12 * std::abs(Force(p))) << i;  // powers of two
  }
}

TEST(MagnetForce, StaysWithinTheForceOfOneCoilAtItsMaximum) {
  Random random(16);
  for (int i = 0; i < kDraws; ++i) {
    Point p = Draw(random);
    p.bias_a = p.magnet.max_coil_current_a * (3.0 * random.Uniform() - 1.0);
    p.control_a = p.magnet.max_coil_current_a * (8.0 * random.Uniform() - 4.0);
    const double nearest_m = p.magnet.gap_m - std::abs(p.x_m);
    const double most_n =
        p.magnet.force_constant_n_m2_per_a2 * std::pow(p.magnet.max_coil_current_a / nearest_m, 2);
    EXPECT_LE(std::abs(Force(p)), most_n * (1.0 + 1e-12)) << i;  // rounding
  }
}

TEST(MagnetForce, ShowsWhatIsNotANumber) {
  const Magnet m{1e-6, 0.4e-3, 2.0};
  EXPECT_TRUE(std::isnan(Force(m, std::nan(""), 0.0, 0.0)));
  EXPECT_TRUE(std::isnan(Force(m, 1.0, std::nan(""), 0.0)));
  EXPECT_TRUE(std::isnan(Force(m, 1.0, 0.0, std::nan(""))));
  // An endless current is cut to the coil's maximum like any other.
  EXPECT_EQ(Force(m, 1.0, INFINITY, 0.0), Force(m, 1.0, 1.0, 0.0));
}

TEST(LawOfPoles, IsThePullOfTheFluxOnBothPoleFacesWhereverTheRotorStands) {
  // B = mu0 N i/(2 s) in two gaps; each face pulls B^2 A/(2 mu0), its share along the axis cos a. A
  // rotor displaced by x along the axis stands x cos a nearer to each face.
  Random random(17);
  constexpr double kMu0 = 1.25663706212e-6;  // CODATA 2018
  for (int i = 0; i < kDraws; ++i) {
    const double turns = 20.0 + std::floor(400.0 * random.Uniform());
    const double area_m2 = 1e-5 + 1e-3 * random.Uniform();
    const double angle_rad = 0.7 * random.Uniform();
    const double current_a = 0.1 + 5.0 * random.Uniform();
    const double gap_m = 0.2e-3 + 1e-3 * random.Uniform();
    const double x_m = (random.Uniform() - 0.5) * gap_m;
    const double flux_t = kMu0 * turns * current_a / (2.0 * (gap_m - x_m * std::cos(angle_rad)));
    const double pull_n = 2.0 * flux_t * flux_t * area_m2 / (2.0 * kMu0) * std::cos(angle_rad);
    const AxisLaw law = LawOfPoles(turns, area_m2, angle_rad, gap_m);
    const Magnet m{law.force_constant_n_m2_per_a2, law.gap_m, 10.0};
    // One coil alone: bias equal to control. The defined mu0 of before 2019 differs by 6e-10.
    EXPECT_NEAR(Force(m, current_a / 2.0, current_a / 2.0, x_m), pull_n, 1e-8 * pull_n) << i;
  }
}

}  // namespace
}  // namespace levitas::magnet

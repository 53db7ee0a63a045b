#include "plant_sim/gear/mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace levitas::gear {
namespace {

constexpr double kPi = std::numbers::pi;
// Forces of some 10 N: rounding of a few operations.
constexpr double kRounding_n = 1e-12;

MeshLaw Law(Direction direction = Direction::kIsotropic) {
  MeshLaw law;
  law.direction = direction;
  law.normal = LineOfAction(20.0 * kPi / 180.0);
  law.stiffness_n_per_m = 1e6;
  law.damping_n_s_per_m = 300.0;
  law.driving_teeth = 20;
  law.driven_teeth = 40;
  return law;
}

Engagement At(double driving_rad) {
  return {
      {std::cos(20.0 * driving_rad), std::sin(20.0 * driving_rad)}, driving_rad, 0.5 * driving_rad};
}

TEST(LineOfAction, StandsAtThePressureAngleFromTheCommonTangent) {
  const Vector n = LineOfAction(0.3);
  EXPECT_DOUBLE_EQ(n.x, std::sin(0.3));
  EXPECT_DOUBLE_EQ(n.y, std::cos(0.3));
}

TEST(MeshForce, IsASpringAndADamperInEveryDirectionWhenIsotropic) {
  const Vector force = MeshForce(Law(), At(0.1), {3e-6, -4e-6}, {1e-3, 2e-3});
  EXPECT_NEAR(force.x, 3.0 + 0.3, kRounding_n);
  EXPECT_NEAR(force.y, -4.0 + 0.6, kRounding_n);
}

TEST(MeshForce, ActsAlongTheLineOfActionAlone) {
  const MeshLaw law = Law(Direction::kLineOfAction);
  const Vector& n = law.normal;
  const Vector across = MeshForce(law, At(0.1), 1e-5 * Vector{-n.y, n.x}, {});
  EXPECT_NEAR(across.x, 0.0, kRounding_n);
  EXPECT_NEAR(across.y, 0.0, kRounding_n);
  const Vector along = MeshForce(law, At(0.1), 1e-5 * n, {});
  EXPECT_NEAR(Dot(along, n), 10.0, kRounding_n);
  EXPECT_NEAR(Dot(along, {-n.y, n.x}), 0.0, kRounding_n);
}

TEST(MeshForce, IsTheSameWithAndWithoutAStaticLoadWhileTheTeethTouch) {
  MeshLaw loaded = Law();
  loaded.preload_n = 100.0;
  const Vector delta_m{2e-6, 5e-6};
  const Vector with = MeshForce(loaded, At(0.1), delta_m, {});
  const Vector without = MeshForce(Law(), At(0.1), delta_m, {});
  EXPECT_NEAR(with.x, without.x, 1e-10);  // 100 N added and taken away
  EXPECT_NEAR(with.y, without.y, 1e-10);
}

TEST(Backlash, LeavesNoForceWithinTheGap) {
  MeshLaw law = Law();
  law.half_backlash_m = 10e-6;
  const Vector inside = MeshForce(law, At(0.1), {6e-6, 6e-6}, {0.1, 0.1});
  EXPECT_EQ(inside.x, 0.0);
  EXPECT_EQ(inside.y, 0.0);
  // Beyond it the spring starts anew at the flank: 15 um of which 10 um are gap.
  EXPECT_NEAR(MeshForce(law, At(0.1), {15e-6, 0.0}, {}).x, 5.0, kRounding_n);
  EXPECT_NEAR(MeshForce(law, At(0.1), {-15e-6, 0.0}, {}).x, -5.0, kRounding_n);
}

TEST(Backlash, LetsTheDampingTakeNoMoreThanTheSpringPresses) {
  // 5 N of spring beyond the gap, 300 N s/m of damping: teeth that part at 0.1 m/s do not hold each
  // other back with 25 N.
  for (const auto direction : {Direction::kIsotropic, Direction::kLineOfAction}) {
    MeshLaw law = Law(direction);
    law.half_backlash_m = 10e-6;
    const Vector& n = law.normal;
    for (const double side : {1.0, -1.0}) {
      const auto pressed = [&](double rate_m_per_s) {
        return side * Dot(MeshForce(law, At(0.1), side * 15e-6 * n, side * rate_m_per_s * n), n);
      };
      EXPECT_NEAR(pressed(-0.1), 0.0, 10.0 * kRounding_n);
      EXPECT_NEAR(pressed(-0.01), 2.0, 10.0 * kRounding_n);
      EXPECT_NEAR(pressed(0.1), 35.0, 10.0 * kRounding_n);
    }
    law.half_backlash_m = 0.0;  // what leaves one flank lies on the other
    EXPECT_NEAR(Dot(MeshForce(law, At(0.1), 15e-6 * n, -0.1 * n), n), -15.0, 10.0 * kRounding_n);
  }
}

TEST(Backlash, UnderLoadPartingTeethLackAtMostTheLoad) {
  MeshLaw law = Law(Direction::kLineOfAction);
  law.half_backlash_m = 10e-6;
  law.preload_n = 20.0;
  const Vector& n = law.normal;
  // 5 um of the load's 20 um are left, and the teeth part fast: no force between them, 20 N
  // missing.
  EXPECT_NEAR(Dot(MeshForce(law, At(0.1), -15e-6 * n, -0.1 * n), n), -20.0, 10.0 * kRounding_n);
}

TEST(Backlash, TakesAwayOnlyTheLoadWhenTheTeethSeparate) {
  MeshLaw law = Law(Direction::kLineOfAction);
  law.half_backlash_m = 10e-6;
  law.preload_n = 20.0;  // 20 um of deflection
  const Vector& n = law.normal;
  // While pressed together: linear.
  EXPECT_NEAR(Dot(MeshForce(law, At(0.1), -15e-6 * n, {}), n), -15.0, 1e-10);
  // In the gap: the static load of 20 N is missing, and no more.
  EXPECT_NEAR(Dot(MeshForce(law, At(0.1), -30e-6 * n, {}), n), -20.0, 1e-10);
  // At the other flank (20 um of load and 20 um of gap passed): 5 um of spring more.
  EXPECT_NEAR(Dot(MeshForce(law, At(0.1), -45e-6 * n, {}), n), -25.0, 1e-10);
}

TEST(Backlash, LetsTeethThatPartFastGoInsteadOfHoldingThemBack) {
  MeshLaw law = Law(Direction::kLineOfAction);
  law.half_backlash_m = 10e-6;
  const Vector& n = law.normal;
  // 1 um of deflection pushes with 1 N; parting at 10 mm/s the damper would pull with 3 N.
  const double spring_and_damper_n = 1e6 * 1e-6 - 300.0 * 0.01;
  ASSERT_LT(spring_and_damper_n, 0.0);
  EXPECT_EQ(Dot(MeshForce(law, At(0.1), 11e-6 * n, -0.01 * n), n), 0.0);
  EXPECT_EQ(Dot(MeshForce(law, At(0.1), -11e-6 * n, 0.01 * n), n), 0.0);
  // Slowly they still push, less than the spring alone.
  EXPECT_NEAR(Dot(MeshForce(law, At(0.1), 11e-6 * n, -0.001 * n), n), 0.7, 1e-9);
  // Of teeth without room to part both flanks are in contact: the linear law pulls and pushes.
  law.half_backlash_m = 0.0;
  EXPECT_NEAR(Dot(MeshForce(law, At(0.1), 1e-6 * n, -0.01 * n), n), spring_and_damper_n, 1e-9);
}

TEST(Friction, ChangesItsSignAtThePitchPoint) {
  MeshLaw law = Law(Direction::kLineOfAction);
  law.friction = 0.1;
  const Vector& n = law.normal;
  const Vector across{-n.y, n.x};
  const double before = Dot(MeshForce(law, At(-0.25 * kPi / 20.0), 1e-5 * n, {}), across);
  const double behind = Dot(MeshForce(law, At(0.25 * kPi / 20.0), 1e-5 * n, {}), across);
  // A quarter of half an engagement away the sign is whole but for the width of the turn, 0.3 %.
  EXPECT_NEAR(behind, 0.1 * 10.0, 0.01);
  EXPECT_NEAR(before, -behind, kRounding_n);
  EXPECT_NEAR(Dot(MeshForce(law, At(0.0), 1e-5 * n, {}), across), 0.0, kRounding_n);
}

TEST(StiffnessFactor, VariesWithTheToothEngagement) {
  MeshLaw law = Law();
  law.variation = {{1, 0.2, 0.0}, {2, 0.1, 1.0}};
  for (const double wheel_rad : {0.0, 0.05, 0.2}) {
    const double mesh_rad = 20.0 * wheel_rad;
    EXPECT_NEAR(StiffnessFactor(law, At(wheel_rad)),
                1.0 + 0.2 * std::cos(mesh_rad) + 0.1 * std::cos(2.0 * mesh_rad + 1.0), 1e-12);
  }
}

TEST(ToothCrack, WeakensTheMeshOnceATurnAtItsTooth) {
  MeshLaw law = Law();
  law.cracks = {{false, 5, 0.3}};
  const double pitch_rad = 2.0 * kPi / 20.0;
  EXPECT_NEAR(StiffnessFactor(law, At(5.0 * pitch_rad)), 0.7, 1e-12);
  EXPECT_NEAR(StiffnessFactor(law, At(5.0 * pitch_rad + 2.0 * kPi)), 0.7, 1e-9);
  EXPECT_NEAR(StiffnessFactor(law, At(5.0 * pitch_rad - 4.0 * kPi)), 0.7, 1e-9);
  for (const double tooth : {0.0, 3.9, 6.1, 10.0, 19.0}) {
    EXPECT_EQ(StiffnessFactor(law, At(tooth * pitch_rad)), 1.0) << tooth;
  }
}

TEST(ToothCrack, OfTheDrivenWheelReturnsWithItsTurns) {
  MeshLaw law = Law();
  law.cracks = {{true, 3, 0.3}};
  const double turn_of_driven = 4.0 * kPi;  // 40 teeth on 20
  const double at_rad = 3.0 * 2.0 * kPi / 20.0;
  EXPECT_NEAR(StiffnessFactor(law, At(at_rad)), 0.7, 1e-12);
  EXPECT_EQ(StiffnessFactor(law, At(at_rad + 0.5 * turn_of_driven)), 1.0);
  EXPECT_NEAR(StiffnessFactor(law, At(at_rad + turn_of_driven)), 0.7, 1e-9);
}

TEST(LinearMesh, IsTheSlopeOfTheForce) {
  for (const auto direction : {Direction::kIsotropic, Direction::kLineOfAction}) {
    for (const double half_gap_m : {0.0, 10e-6}) {
      MeshLaw law = Law(direction);
      law.half_backlash_m = half_gap_m;
      law.preload_n = 50.0;
      const Vector& n = law.normal;
      const Vector t{-n.y, n.x};
      const double step_m = 1e-10;
      const LinearMesh linear = Linearise(law);
      // Central differences: error of second order in 1e-10 m / 60 um, and rounding 1e-14/1e-10.
      const double normal = (Dot(MeshForce(law, At(0.1), step_m * n, {}), n) -
                             Dot(MeshForce(law, At(0.1), -step_m * n, {}), n)) /
                            (2.0 * step_m);
      const double across = (Dot(MeshForce(law, At(0.1), step_m * t, {}), t) -
                             Dot(MeshForce(law, At(0.1), -step_m * t, {}), t)) /
                            (2.0 * step_m);
      EXPECT_NEAR(normal, linear.normal_n_per_m, 1e3);
      EXPECT_NEAR(across, linear.tangential_n_per_m, 1e3);
    }
  }
}

TEST(LinearMesh, IsNothingForGearsThatStandInTheirGap) {
  MeshLaw law = Law();
  law.half_backlash_m = 1e-6;
  EXPECT_EQ(Linearise(law).normal_n_per_m, 0.0);
  EXPECT_EQ(Linearise(law).normal_n_s_per_m, 0.0);
}

}  // namespace
}  // namespace levitas::gear

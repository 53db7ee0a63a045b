#include "analysis/rotor_figures.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "tests/support/geared_rigs.hpp"
#include "tests/support/test_rigs.hpp"

namespace levitas::analysis {
namespace {

constexpr double kLength = 0.6, kDiameter = 0.01, kDensity = 7800.0;

/// A plain round shaft, between two bearings.
plant::PlantConfig Shaft() {
  plant::PlantConfig rig = test::QuietFlexibleRotor();
  rig.rotor = {};
  rig.rotor.material = {2e11, 0.3, kDensity};
  rig.rotor.sections = {{kLength, kDiameter, 0.0}};
  rig.rotor.max_element_length_m = 0.01;
  rig.unbalance.clear();
  rig.bearings[0].actuator_z_m = rig.bearings[0].sensor_z_m = 0.1;
  rig.bearings[1].actuator_z_m = rig.bearings[1].sensor_z_m = 0.4;
  rig.gravity_m_per_s2 = 10.0;
  return rig;
}

TEST(RotorFigures, OfAPlainShaftAreThoseOfACylinder) {
  const RotorFigures figures = FiguresOf(Shaft(), 1);
  const double mass = kDensity * std::numbers::pi / 4.0 * kDiameter * kDiameter * kLength;
  const double radius = kDiameter / 2.0;
  EXPECT_NEAR(figures.mass_kg, mass, 1e-9 * mass);
  EXPECT_NEAR(figures.centre_z_m, kLength / 2.0, 1e-9);
  const double transverse = mass / 12.0 * (3.0 * radius * radius + kLength * kLength);
  EXPECT_NEAR(figures.transverse_inertia_kg_m2, transverse, 1e-6 * transverse);
  const double polar = mass * radius * radius / 2.0;
  EXPECT_NEAR(figures.polar_inertia_kg_m2, polar, 1e-6 * polar);
}

// Weight W at 300 mm between bearings at 100 and 400 mm: a third and two thirds of it.
TEST(RotorFigures, ShareTheWeightByTheLever) {
  const RotorFigures figures = FiguresOf(Shaft(), 1);
  const double weight = 10.0 * figures.mass_kg;
  ASSERT_EQ(figures.loads.size(), 2U);
  EXPECT_NEAR(*figures.loads[0].load_n, weight / 3.0, 1e-6);
  EXPECT_NEAR(*figures.loads[1].load_n, 2.0 * weight / 3.0, 1e-6);
}

TEST(RotorFigures, HoldAnOverhungRotorDownAtItsFarBearing) {
  auto rig = Shaft();
  rig.bearings[1].actuator_z_m = rig.bearings[1].sensor_z_m = 0.25;  // the centre is beyond
  const RotorFigures figures = FiguresOf(rig, 1);
  EXPECT_LT(*figures.loads[0].load_n, 0.0);
  EXPECT_GT(*figures.loads[1].load_n, 10.0 * figures.mass_kg);
}

TEST(RotorFigures, GiveOneBearingAllAndThreeNone) {
  auto rig = Shaft();
  rig.bearings.pop_back();
  const RotorFigures one = FiguresOf(rig, 1);
  EXPECT_DOUBLE_EQ(*one.loads[0].load_n, 10.0 * one.mass_kg);
  rig.bearings.resize(3, rig.bearings[0]);
  for (const StaticLoad& load : FiguresOf(rig, 1).loads) EXPECT_FALSE(load.load_n);
}

// A slender free beam bends with nodes at 22.42 % of its length (any table of beams).
TEST(ModeShapes, OfASlenderBeamHaveTheirNodesWhereTablesHaveThem) {
  const ModeShape shape = FiguresOf(Shaft(), 2).shapes.at(0);
  std::vector<double> nodes;
  for (std::size_t i = 1; i < shape.z_m.size(); ++i) {
    const double a = shape.deflection[i - 1];
    const double b = shape.deflection[i];
    if (a * b >= 0.0) continue;
    nodes.push_back(shape.z_m[i - 1] + (shape.z_m[i] - shape.z_m[i - 1]) * a / (a - b));
  }
  ASSERT_EQ(nodes.size(), 2U);
  EXPECT_NEAR(nodes[0], 0.2242 * kLength, 1e-3 * kLength);
  EXPECT_NEAR(nodes[1], (1.0 - 0.2242) * kLength, 1e-3 * kLength);
  double largest = 0.0;
  for (const double d : shape.deflection) largest = std::max(largest, std::abs(d));
  EXPECT_DOUBLE_EQ(largest, 1.0);
}

TEST(RotorFigures, OfARotorThatCannotTiltHaveNoShapes) {
  auto rig = Shaft();
  rig.bearings.pop_back();
  rig.bearings[0].actuator_z_m = rig.bearings[0].sensor_z_m = 0.0;
  rig.rotor.given = rotor::GivenRotor{0.5, 0.0, 0.0, 0.0, {}, {}};
  const RotorFigures figures = FiguresOf(rig, 4);
  EXPECT_NEAR(figures.mass_kg, 0.5, 1e-12);
  EXPECT_NEAR(figures.transverse_inertia_kg_m2, 0.0, 1e-12);
  EXPECT_TRUE(figures.shapes.empty());
}

TEST(RotorFigures, OfGearedShaftsAreRefused) {
  EXPECT_THROW((void)FiguresOf(test::GearedRotor4(), 1), std::invalid_argument);
}

}  // namespace
}  // namespace levitas::analysis

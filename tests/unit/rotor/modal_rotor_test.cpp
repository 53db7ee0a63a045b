#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "plant_sim/rotor/finite_element.hpp"
#include "tests/support/reference_csv.hpp"
#include "tests/support/test_rigs.hpp"

namespace levitas::rotor {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;

FiniteElementModel Flexible() {
  const auto config = test::QuietFlexibleRotor();
  return Assemble(config.rotor, {0.1099, 0.1299, 0.3996, 0.4196});
}

TEST(FreeWhirl, AgreesWithTheIndependentCampbellDiagramAtEverySpeed) {
  const auto model = Flexible();
  for (const auto& row : test::ReadReference("flexible_rotor_campbell.csv")) {
    const auto whirl = FreeWhirl(model, row[0] * kTwoPi / 60.0, 4);
    ASSERT_EQ(whirl.backward_hz.size(), 4U);
    ASSERT_EQ(whirl.forward_hz.size(), 4U);
    for (std::size_t mode = 0; mode < 4; ++mode) {
      // 0.1 %: what two independent programs with different meshes can agree on (they differ 0.05
      // %)
      EXPECT_NEAR(whirl.backward_hz[mode] / row[1 + 2 * mode], 1.0, 1e-3) << row[0] << " rpm";
      EXPECT_NEAR(whirl.forward_hz[mode] / row[2 + 2 * mode], 1.0, 1e-3) << row[0] << " rpm";
    }
  }
}

TEST(Assemble, WeighsThePublishedRigWithItsRings) {
  const auto model = Assemble(test::UfuRig().rotor, {});
  EXPECT_NEAR(model.total_mass_kg / 5.936, 1.0, 0.01);  // published to four digits
  const auto whirl = FreeWhirl(model, 0.0, 4);
  const double published_hz[] = {104.2, 400.3, 768.2, 1117.6};
  for (std::size_t mode = 0; mode < 4; ++mode) {
    EXPECT_NEAR(whirl.forward_hz[mode] / published_hz[mode], 1.0, 0.01) << mode;
  }
}

TEST(FreeWhirl, SplitsForwardAndBackwardOnlyWhenTheRotorTurns) {
  const auto still = FreeWhirl(Flexible(), 0.0, 4);
  const auto turning = FreeWhirl(Flexible(), 300.0, 4);
  for (std::size_t mode = 0; mode < 4; ++mode) {
    EXPECT_NEAR(still.forward_hz[mode] / still.backward_hz[mode], 1.0, 1e-9);
    EXPECT_GT(turning.forward_hz[mode], turning.backward_hz[mode]);
  }
}

TEST(FreeWhirl, MirrorsForwardAndBackwardWhenTheRotorTurnsTheOtherWay) {
  const auto one = FreeWhirl(Flexible(), 300.0, 4);
  const auto other = FreeWhirl(Flexible(), -300.0, 4);
  for (std::size_t mode = 0; mode < 4; ++mode) {
    EXPECT_NEAR(one.forward_hz[mode] / other.backward_hz[mode], 1.0, 1e-9);  // solver's rounding
  }
}

TEST(FreeWhirl, LeavesOutTheConicalWhirlOfTheRigidBody) {
  // A flat heavy disc precesses at Ip/Id = 2 times the speed: 95 Hz here, far above a flexible mode
  // of no speed at all, and still not one of the shaft's.
  RotorConfig config;
  config.material = {210e9, 0.3, 7850.0};
  config.sections = {{0.5, 0.03, 0.0}};
  config.discs = {{0.25, 5.0, 0.05, 0.1}};
  config.max_element_length_m = 0.05;
  const auto model = Assemble(config, {});
  const auto still = FreeWhirl(model, 0.0, 2);
  const auto turning = FreeWhirl(model, 300.0, 2);
  // The first bending mode is symmetric: the disc in the middle does not tilt, so the gyroscopic
  // effect is only the thin shaft's.
  EXPECT_NEAR(turning.forward_hz[0] / still.forward_hz[0], 1.0, 0.01);
}

TEST(Reduce, GivesMassNormalisedModesOrthogonalToTheMassMatrix) {
  const auto model = Flexible();
  const auto modal = Reduce(model, 8, 0.003);
  const Eigen::Index nodes = modal.shapes.rows();
  Eigen::MatrixXd phi(2 * nodes, 8);
  for (Eigen::Index i = 0; i < nodes; ++i) {
    phi.row(2 * i) = modal.shapes.row(i);
    phi.row(2 * i + 1) = modal.slopes.row(i);
  }
  const Eigen::MatrixXd mass = phi.transpose() * model.mass * phi;
  EXPECT_LT((mass - Eigen::MatrixXd::Identity(8, 8)).cwiseAbs().maxCoeff(), 1e-9);  // rounding
  EXPECT_EQ(modal.frequency_rad_per_s[0], 0.0);
  EXPECT_EQ(modal.frequency_rad_per_s[1], 0.0);
  EXPECT_EQ(modal.damping_ratio[1], 0.0);
  EXPECT_EQ(modal.damping_ratio[2], 0.003);
}

TEST(Reduce, KeepsAllModesWhenToldZero) {
  const auto model = Flexible();
  EXPECT_EQ(Reduce(model, 0, 0.0).frequency_rad_per_s.size(), model.mass.rows());
}

TEST(Reduce, RefusesToDropARigidModeOrToInventModes) {
  const auto model = Flexible();
  EXPECT_THROW((void)Reduce(model, 1, 0.0), std::invalid_argument);
  EXPECT_THROW((void)Reduce(model, 10'000, 0.0), std::invalid_argument);
  EXPECT_THROW((void)Reduce(model, 8, 1.0), std::invalid_argument);
}

TEST(ShapeAt, RefusesAPlaneThatIsNoNode) {
  const auto modal = Reduce(Flexible(), 4, 0.0);
  EXPECT_NO_THROW((void)modal.ShapeAt(0.1099));
  try {
    (void)modal.ShapeAt(0.11);
    FAIL() << "0.11 m is no node";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "rotor: no node at z = 0.11 m; name it as a plane");
  }
}

TEST(Assemble, DividesSectionsAndKeepsEveryPlaneAsANode) {
  RotorConfig config;
  config.material = {210e9, 0.3, 7850.0};
  config.sections = {{0.1, 0.02, 0.0}, {0.05, 0.03, 0.0}};
  config.max_element_length_m = 0.03;
  const auto model = Assemble(config, {0.07});
  // 0 to 0.07 in three, 0.07 to 0.1 in one, 0.1 to 0.15 in two.
  ASSERT_EQ(model.node_z_m.size(), 7U);
  EXPECT_DOUBLE_EQ(model.node_z_m[3], 0.07);
  EXPECT_DOUBLE_EQ(model.node_z_m[4], 0.1);
  const double area_length = 0.1 * 0.02 * 0.02 + 0.05 * 0.03 * 0.03;
  EXPECT_NEAR(model.total_mass_kg, 7850.0 * std::numbers::pi / 4.0 * area_length, 1e-12);
}

TEST(Assemble, RefusesImpossibleShafts) {
  const auto good = test::QuietFlexibleRotor().rotor;
  auto config = good;
  config.sections[0].inner_diameter_m = 0.02;
  EXPECT_THROW((void)Assemble(config, {}), std::invalid_argument);
  config = good;
  config.sections.clear();
  EXPECT_THROW((void)Assemble(config, {}), std::invalid_argument);
  config = good;
  config.discs[0].z_m = 0.5;  // the shaft ends at 0.4572
  EXPECT_THROW((void)Assemble(config, {}), std::invalid_argument);
  config = good;
  config.material.young_pa = std::nan("");
  EXPECT_THROW((void)Assemble(config, {}), std::invalid_argument);
  config = good;
  config.rings = {{0.1, 0.01, 0.05, 0.04, 7850.0}};  // bore larger than its outside
  EXPECT_THROW((void)Assemble(config, {}), std::invalid_argument);
}

}  // namespace
}  // namespace levitas::rotor

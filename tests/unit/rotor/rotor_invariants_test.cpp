// What holds for every rotor, on rotors drawn from written seeds.

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "numerics/dense/eigenvalues.hpp"
#include "numerics/dense/factorisations.hpp"
#include "plant_sim/rotor/finite_element.hpp"
#include "tests/unit/rotor/random_rotor.hpp"
#include "tests/unit/rotor/support_conditions.hpp"

namespace levitas::rotor {
namespace {

class AnyRotor : public testing::TestWithParam<std::uint64_t> {
 protected:
  AnyRotor() : config(RandomRotor(GetParam())), model(Assemble(config, {})) {}

  // Unit translation, and unit rotation about z = 0.
  [[nodiscard]] Eigen::MatrixXd RigidMotion() const {
    Eigen::MatrixXd rigid = Eigen::MatrixXd::Zero(model.mass.rows(), 2);
    for (std::size_t i = 0; i < model.node_z_m.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(2 * i);
      rigid(row, 0) = 1.0;
      rigid(row, 1) = model.node_z_m[i];
      rigid(row + 1, 1) = 1.0;
    }
    return rigid;
  }

  RotorConfig config;
  FiniteElementModel model;
};

INSTANTIATE_TEST_SUITE_P(Seeds, AnyRotor, testing::Range<std::uint64_t>(1, 13));

TEST_P(AnyRotor, HasTheMassCentreAndInertiasOfItsSolidBodies) {
  const auto body = AsRigidBody(config);
  const Eigen::MatrixXd rigid = RigidMotion();
  const Eigen::Matrix2d mass = rigid.transpose() * model.mass * rigid;
  const Eigen::Matrix2d gyroscopic = rigid.transpose() * model.gyroscopic * rigid;
  // Sums of some hundred products: rounding.
  EXPECT_NEAR(model.total_mass_kg / body.mass_kg, 1.0, 1e-12);
  EXPECT_NEAR(mass(0, 0) / body.mass_kg, 1.0, 1e-12);
  EXPECT_NEAR(mass(0, 1) / body.first_moment_kg_m, 1.0, 1e-12);
  EXPECT_NEAR(mass(1, 1) / body.transverse_kg_m2, 1.0, 1e-12);
  EXPECT_NEAR(gyroscopic(1, 1) / body.polar_kg_m2, 1.0, 1e-11);
  EXPECT_NEAR(gyroscopic(0, 1), 0.0, 1e-12);  // a translation tilts no disc
}

TEST_P(AnyRotor, ResistsNoRigidMotionAndEveryOther) {
  const Eigen::MatrixXd rigid = RigidMotion();
  const double scale = model.stiffness.cwiseAbs().maxCoeff();
  EXPECT_LT((model.stiffness * rigid).cwiseAbs().maxCoeff() / scale, 1e-13);  // rounding
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(model.stiffness);
  // Two zeros up to the solver's rounding; the third eigenvalue belongs to bending.
  EXPECT_LT(std::abs(solver.eigenvalues()[1]), 1e-12 * solver.eigenvalues().maxCoeff());
  EXPECT_GT(solver.eigenvalues()[2], 10.0 * std::abs(solver.eigenvalues()[1]));
}

TEST_P(AnyRotor, HasSymmetricMatricesAPositiveMassAndNoNegativePolarInertia) {
  EXPECT_EQ(model.mass, model.mass.transpose());
  EXPECT_EQ(model.stiffness, model.stiffness.transpose());
  EXPECT_EQ(model.gyroscopic, model.gyroscopic.transpose());
  EXPECT_EQ(Eigen::LLT<Eigen::MatrixXd>(model.mass).info(), Eigen::Success);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> polar(model.gyroscopic);
  EXPECT_GT(polar.eigenvalues()[0], -1e-12 * polar.eigenvalues().maxCoeff());  // rounding
}

TEST_P(AnyRotor, IsTheSameRotorSeenFromTheOtherEnd) {
  double length_m = 0.0;
  for (const auto& s : config.sections) length_m += s.length_m;
  RotorConfig turned = config;
  std::reverse(turned.sections.begin(), turned.sections.end());
  for (auto& d : turned.discs) d.z_m = length_m - d.z_m;
  for (auto& r : turned.rings) r.z_m = length_m - r.z_m;
  const auto one = FreeWhirl(model, 400.0, 4);
  const auto other = FreeWhirl(Assemble(turned, {}), 400.0, 4);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(one.forward_hz[i] / other.forward_hz[i], 1.0, 1e-8) << i;  // solver's rounding
    EXPECT_NEAR(one.backward_hz[i] / other.backward_hz[i], 1.0, 1e-8) << i;
  }
}

// w ~ sqrt(E/rho)/length: a model of twice the size at half the speed, of the same material, rings
// at half the frequency.
TEST_P(AnyRotor, ObeysTheScalingOfSizeAndModulus) {
  RotorConfig large = config;
  for (auto& s : large.sections) {
    s = {2.0 * s.length_m, 2.0 * s.outer_diameter_m, 2.0 * s.inner_diameter_m};
  }
  for (auto& d : large.discs) {
    d = {2.0 * d.z_m, 8.0 * d.mass_kg, 32.0 * d.diametral_inertia_kg_m2,
         32.0 * d.polar_inertia_kg_m2};
  }
  for (auto& r : large.rings) {
    r = {2.0 * r.z_m, 2.0 * r.width_m, 2.0 * r.bore_m, 2.0 * r.outer_diameter_m,
         r.density_kg_per_m3};
  }
  large.max_element_length_m *= 2.0;
  RotorConfig stiff = config;
  stiff.material.young_pa *= 4.0;
  const auto base = FreeWhirl(model, 600.0, 4);
  const auto larger = FreeWhirl(Assemble(large, {}), 300.0, 4);
  const auto stiffer = FreeWhirl(Assemble(stiff, {}), 1200.0, 4);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(larger.forward_hz[i] / base.forward_hz[i], 0.5, 1e-8) << i;  // solver's rounding
    EXPECT_NEAR(larger.backward_hz[i] / base.backward_hz[i], 0.5, 1e-8) << i;
    EXPECT_NEAR(stiffer.forward_hz[i] / base.forward_hz[i], 2.0, 1e-8) << i;
  }
}

TEST_P(AnyRotor, RingsLowerWithEveryAddedMass) {
  RotorConfig heavier = config;  // on a node that exists, so that the mesh stays the same
  heavier.discs.push_back({config.discs[0].z_m, 0.5, 1e-3, 0.0});
  const auto light = FreeWhirl(model, 0.0, 6);
  const auto heavy = FreeWhirl(Assemble(heavier, {}), 0.0, 6);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_LE(heavy.forward_hz[i], light.forward_hz[i] * (1.0 + 1e-9)) << i;  // solver's rounding
  }
}

TEST_P(AnyRotor, RaisesForwardAndLowersBackwardWhirlMonotonicallyWithTheSpeed) {
  // d w/d W of a forward mode is u'G u times a positive number, and G has no negative direction.
  // On the held rotor, which has no rigid whirl among its modes.
  const auto shaft = PinnedAtBothEnds(model);
  auto forward = Forward(shaft, 0.0);
  auto backward = Backward(shaft, 0.0);
  for (const double speed_rad_per_s : {100.0, 1000.0, 5000.0}) {
    const auto faster = Forward(shaft, speed_rad_per_s);
    const auto slower = Backward(shaft, speed_rad_per_s);
    for (std::size_t i = 0; i < forward.size(); ++i) {
      EXPECT_GE(faster[i], forward[i] * (1.0 - 1e-9)) << i;  // solver's rounding
      EXPECT_LE(slower[i], backward[i] * (1.0 + 1e-9)) << i;
    }
    forward = faster;
    backward = slower;
  }
}

TEST_P(AnyRotor, HasRigidModesOfTheRigidBody) {
  const auto body = AsRigidBody(config);
  const auto modal = Reduce(model, 6, 0.0);
  const double mass_normal = 1.0 / std::sqrt(body.mass_kg);
  const double tilt_normal = 1.0 / std::sqrt(body.TransverseAtCentreKgM2());
  for (Eigen::Index i = 0; i < modal.shapes.rows(); ++i) {
    const double z = modal.node_z_m[static_cast<std::size_t>(i)];
    // Rounding; the inertia at the centre is a difference of larger ones.
    EXPECT_NEAR(modal.shapes(i, 0), mass_normal, 1e-10 * mass_normal);
    EXPECT_NEAR(modal.slopes(i, 0), 0.0, 1e-10 * tilt_normal);
    EXPECT_NEAR(modal.shapes(i, 1), tilt_normal * (z - body.CentreM()), 1e-9 * tilt_normal);
    EXPECT_NEAR(modal.slopes(i, 1), tilt_normal, 1e-9 * tilt_normal);
  }
  // The free body precesses at Ip/It times its speed.
  EXPECT_NEAR(modal.gyroscopic(1, 1) * body.TransverseAtCentreKgM2() / body.polar_kg_m2, 1.0, 1e-9);
}

TEST_P(AnyRotor, LosesNothingWhenAllModesAreKept) {
  // Completeness: Phi Phi^T = M^-1, and Phi^T K Phi = diag(w^2).
  const auto modal = Reduce(model, 0, 0.0);
  const Eigen::Index nodes = modal.shapes.rows();
  Eigen::MatrixXd phi(2 * nodes, modal.shapes.cols());
  for (Eigen::Index i = 0; i < nodes; ++i) {
    phi.row(2 * i) = modal.shapes.row(i);
    phi.row(2 * i + 1) = modal.slopes.row(i);
  }
  const Eigen::MatrixXd identity = phi * phi.transpose() * model.mass;
  // Rounding amplified by the mass matrix's condition number, up to 1e6.
  EXPECT_LT((identity - Eigen::MatrixXd::Identity(2 * nodes, 2 * nodes)).norm() /
                std::sqrt(static_cast<double>(2 * nodes)),
            1e-7);
  const Eigen::MatrixXd spectral = phi.transpose() * model.stiffness * phi;
  const Eigen::MatrixXd expected = modal.frequency_rad_per_s.cwiseAbs2().asDiagonal();
  EXPECT_LT((spectral - expected).cwiseAbs().maxCoeff() / expected.maxCoeff(), 1e-9);
}

TEST_P(AnyRotor, KeepsTheLowestModesUnchangedWhateverIsCutOff) {
  const auto few = Reduce(model, 5, 0.004);
  const auto many = Reduce(model, 12, 0.004);
  EXPECT_EQ(few.frequency_rad_per_s, many.frequency_rad_per_s.head(5));
  EXPECT_EQ(few.shapes, many.shapes.leftCols(5));
  EXPECT_EQ(few.slopes, many.slopes.leftCols(5));
  EXPECT_EQ(few.gyroscopic.rows(), 5);
  // The same sums in another order of the matrix product: rounding.
  EXPECT_LT((few.gyroscopic - many.gyroscopic.topLeftCorner(5, 5)).norm(),
            1e-12 * many.gyroscopic.norm());
  EXPECT_EQ(few.total_mass_kg, many.total_mass_kg);
  for (Eigen::Index i = 2; i < 12; ++i) {
    EXPECT_GE(many.frequency_rad_per_s[i], many.frequency_rad_per_s[i - 1]);
    EXPECT_EQ(many.damping_ratio[i], 0.004);
  }
}

TEST_P(AnyRotor, FindsTheShapeOfEveryNodeAndOfNoPlaceBetween) {
  const auto modal = Reduce(model, 4, 0.0);
  for (std::size_t i = 0; i < modal.node_z_m.size(); ++i) {
    EXPECT_EQ(modal.ShapeAt(modal.node_z_m[i]), modal.shapes.row(static_cast<Eigen::Index>(i)));
    if (i == 0) continue;
    const double between = 0.5 * (modal.node_z_m[i] + modal.node_z_m[i - 1]);
    EXPECT_THROW((void)modal.ShapeAt(between), std::invalid_argument);
  }
  EXPECT_THROW((void)modal.ShapeAt(-1e-6), std::invalid_argument);
  EXPECT_THROW((void)modal.ShapeAt(std::nan("")), std::invalid_argument);
}

// A ring is the disc of the same cylinder, and a short piece of shaft of no stiffness at all.
TEST(Ring, IsTheDiscOfItsCylinder) {
  for (const Ring& ring : {Ring{0.1, 0.02, 0.03, 0.08, 7800.0}, Ring{0.1, 0.001, 0.0, 0.1, 2700.0},
                           Ring{0.1, 0.05, 0.0999, 0.1, 7800.0}}) {
    RigidBody body;
    AddCylinder(body, 0.0, ring.width_m, ring.outer_diameter_m, ring.bore_m,
                ring.density_kg_per_m3);
    RotorConfig config = RandomRotor(1);
    config.rings = {ring};
    const auto as_ring = Assemble(config, {});
    config.rings.clear();
    config.discs.push_back({0.1, body.mass_kg, body.transverse_kg_m2, body.polar_kg_m2});
    const auto as_disc = Assemble(config, {});
    EXPECT_LT((as_ring.mass - as_disc.mass).norm(), 1e-14 * as_disc.mass.norm());  // rounding
    EXPECT_LT((as_ring.gyroscopic - as_disc.gyroscopic).norm(), 1e-14 * as_disc.gyroscopic.norm());
    EXPECT_EQ(as_ring.stiffness, as_disc.stiffness);  // a ring carries nothing
  }
}

}  // namespace
}  // namespace levitas::rotor

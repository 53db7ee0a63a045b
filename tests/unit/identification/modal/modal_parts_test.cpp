// The modal model in closed form: its equation solved at once, reciprocity, a rigid rotor on its
// negative stiffness, whirl of one mode.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <complex>
#include <numbers>
#include <set>

#include "common/two_pi.hpp"
#include "configuration/rig_file.hpp"
#include "identification/modal/modal_line.hpp"
#include "identification/modal/modal_quality.hpp"
#include "identification/modal/modal_response.hpp"
#include "identification/modal/mode_support.hpp"
#include "tests/support/paths.hpp"

namespace levitas::identification {
namespace {

using Complex = std::complex<double>;

const ModalStart& PartsStart(Eigen::Index bending = 5) {
  static const configuration::RigFile rig =
      configuration::LoadRig(test::SourceFolder() + "/config/rigs/flexible_rotor.yaml");
  static const ModalStart five = StartFromRig(rig.plant, 5);
  static const ModalStart none = StartFromRig(rig.plant, 0);
  return bending == 0 ? none : five;
}

Physical PartsNominal(Eigen::Index bending = 5) {
  return ToPhysical(PartsStart(bending).frame, PartsStart(bending).vector);
}

/// D of modal_response.hpp, both planes and magnets, written out in full.
Eigen::MatrixXcd DynamicStiffness(const Physical& rig, double frequency_hz, double speed_rad_per_s,
                                  const Eigen::MatrixXcd& actuator) {
  const Eigen::Index n = rig.frequency_rad_per_s.size();
  const Complex s(0.0, kTwoPi * frequency_hz);
  Eigen::MatrixXcd d = Eigen::MatrixXcd::Zero(2 * n, 2 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double w = rig.frequency_rad_per_s[i];
    d(i, i) = d(n + i, n + i) = s * s + 2.0 * rig.damping_ratio[i] * w * s + w * w;
  }
  d.topRightCorner(n, n) += s * speed_rad_per_s * rig.gyroscopic;
  d.bottomLeftCorner(n, n) -= s * speed_rad_per_s * rig.gyroscopic;
  const Eigen::VectorXcd ks = rig.ks_n_per_m.cast<Complex>();
  return d - actuator * ks.asDiagonal() * actuator.transpose();
}

class AtSpeed : public testing::TestWithParam<double> {};

TEST_P(AtSpeed, MagnetsAddedAfterwardsSolveTheWholeEquation) {
  const Physical rig = PartsNominal();
  for (const double f_hz : {0.7, 20.0, 88.0, 250.0, 777.0}) {
    const ModalLine line = SolveFree(PartsStart().frame, rig, f_hz, GetParam(), true);
    const ClosedLine closed = AddMagnets(line, rig.ks_n_per_m, true);
    const Eigen::MatrixXcd d = DynamicStiffness(rig, f_hz, GetParam(), line.actuator);
    // Woodbury against one dense solution; the condition of D stays below 1e7 here.
    EXPECT_LT((d * closed.x - line.actuator).norm(), 1e-8 * line.actuator.norm()) << f_hz;
    EXPECT_LT((d.transpose() * closed.z - line.sensor).norm(), 1e-8 * line.sensor.norm()) << f_hz;
  }
}

TEST_P(AtSpeed, RotationTheOtherWayRoundTransposesTheResponse) {
  // G enters D antisymmetrically, so D(-speed) = D(speed)^T; with sensors at the magnets and equal
  // chains the response from force to reading is transposed with it.
  Physical rig = PartsNominal();
  rig.sensor = rig.actuator;
  ModalFrame frame = PartsStart().frame;
  frame.beyond.sensor = frame.beyond.actuator;
  for (const double f_hz : {13.0, 91.0, 260.0}) {
    const Eigen::MatrixXcd one = ModalResponse(frame, rig, f_hz, GetParam());
    const Eigen::MatrixXcd other = ModalResponse(frame, rig, f_hz, -GetParam());
    EXPECT_LT((one - other.transpose()).norm(), 1e-10 * one.norm()) << f_hz;
  }
}

TEST_P(AtSpeed, EqualPlanesRespondAlikeAndCoupleWithOppositeSigns) {
  // Nothing of the nominal rotor prefers a plane: a quarter turn of the frame changes nothing.
  const Eigen::MatrixXcd p = ModalResponse(PartsStart().frame, PartsNominal(), 64.0, GetParam());
  for (Eigen::Index out = 0; out < 4; out += 2) {
    for (Eigen::Index in = 0; in < 4; in += 2) {
      EXPECT_LT(std::abs(p(out, in) - p(out + 1, in + 1)), 1e-12 * p.norm());
      EXPECT_LT(std::abs(p(out, in + 1) + p(out + 1, in)), 1e-12 * p.norm());
      if (GetParam() == 0.0) {
        EXPECT_EQ(std::abs(p(out, in + 1)), 0.0);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Speeds, AtSpeed, testing::Values(0.0, 100.0 * std::numbers::pi, 900.0));

TEST(ModalResponse, OfARigidRotorAtRestIsMinusKiOverKs) {
  // Two rigid modes on two magnets: x = -K^-1 F at the magnets, and between and beyond them a
  // straight line through both.
  ModalFrame frame = PartsStart(0).frame;
  frame.beyond.frequency_rad_per_s.resize(0);
  Physical rig = PartsNominal(0);
  rig.gain << 1.0, 1.1, 0.9, 1.05;
  rig.ki_n_per_a << 40.0, 44.0, 35.0, 41.0;
  rig.ks_n_per_m << 1.0e5, 1.2e5, 0.9e5, 1.1e5;
  const Eigen::MatrixXcd p = ModalResponse(frame, rig, 1e-4, 0.0);
  const double span_m = frame.actuator_z_m[1] - frame.actuator_z_m[0];
  for (Eigen::Index out = 0; out < 4; ++out) {
    const double along = (frame.sensor_z_m[out / 2] - frame.actuator_z_m[0]) / span_m;
    for (Eigen::Index in = 0; in < 4; ++in) {
      const double share = in / 2 == 0 ? 1.0 - along : along;
      const double expected =
          out % 2 != in % 2 ? 0.0
                            : -rig.gain[out] * share * rig.ki_n_per_a[in] / rig.ks_n_per_m[in];
      // Inertia at 1e-4 Hz is 1e-11 of the stiffness; the lags turn by 1e-7.
      EXPECT_NEAR(p(out, in).real(), expected, 1e-9 * 5e-4) << out << in;
      EXPECT_NEAR(p(out, in).imag(), 0.0, 1e-6 * 5e-4) << out << in;
    }
  }
}

TEST(WhirlFrequencies, OfOneModeAreTheRootsOfItsQuadratic) {
  // l^2 - l W g - w^2 = 0: l = W g/2 +- sqrt((W g/2)^2 + w^2), beside two rigid modes.
  Physical rig;
  rig.frequency_rad_per_s = Eigen::Vector3d(0.0, 0.0, kTwoPi * 90.0);
  rig.gyroscopic = Eigen::Matrix3d::Zero();
  rig.gyroscopic(2, 2) = 0.13;
  for (const double speed : {0.0, 314.0, -314.0, 2000.0}) {
    const double half = 0.5 * speed * 0.13;
    const double root = std::hypot(half, kTwoPi * 90.0);
    const auto found = WhirlFrequenciesHz(rig, speed);
    ASSERT_EQ(found.size(), 2U) << speed;
    EXPECT_NEAR(found[0], (half - root) / kTwoPi, 1e-9);
    EXPECT_NEAR(found[1], (half + root) / kTwoPi, 1e-9);
  }
}

TEST(PlantFrequencies, WithoutMagnetsAreTheRotorsOwnAndSinkWithThemToFirstOrder) {
  Physical rig = PartsNominal();
  const Eigen::VectorXd ks = rig.ks_n_per_m;
  rig.ks_n_per_m.setZero();
  const auto own = PlantFrequenciesHz(rig, false);
  rig.ks_n_per_m = 1e-3 * ks;
  rig.ks_n_per_m[1] = rig.ks_n_per_m[3] = 0.0;  // of the other plane
  const auto held = PlantFrequenciesHz(rig, false);
  const auto other = PlantFrequenciesHz(rig, true);
  ASSERT_GE(held.size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) {
    const auto mode = static_cast<Eigen::Index>(2 + i);
    const double f = own[own.size() - 5 + i];
    EXPECT_NEAR(f, rig.frequency_rad_per_s[mode] / kTwoPi, 1e-9 * f);
    EXPECT_NEAR(other[other.size() - 5 + i], f, 1e-12 * f);
    // d(w^2) = -sum ks a^2; what is left out is of the square of a thousandth.
    double square = rig.frequency_rad_per_s[mode] * rig.frequency_rad_per_s[mode];
    for (Eigen::Index b = 0; b < 2; ++b) {
      square -= rig.ks_n_per_m[2 * b] * rig.actuator(mode, b) * rig.actuator(mode, b);
    }
    const double shift = f - std::sqrt(square) / kTwoPi;
    EXPECT_NEAR(f - held[held.size() - 5 + i], shift, 1e-2 * shift + 1e-9) << i;
  }
}

TEST(SupportOf, AModeIsShownWithinAPerCentOfItsPoleAndMovedBeyond) {
  const Physical rig = PartsNominal();
  const auto plant = PlantFrequenciesHz(rig, false);
  Assigned assigned(5);
  const double second_hz = plant[plant.size() - 4];
  const double third_hz = plant[plant.size() - 3];
  assigned[1] = ProposedMode{1.009 * second_hz, 0.003, 1.0, 0.0};
  assigned[2] = ProposedMode{1.012 * third_hz, 0.003, 1.0, 0.0};
  const auto support = SupportOf(rig, assigned);
  EXPECT_EQ(support[0].support, Support::kNotShown);
  EXPECT_EQ(support[0].shown_hz, 0.0);
  EXPECT_EQ(support[1].support, Support::kShown);
  EXPECT_EQ(support[2].support, Support::kMoved);
  EXPECT_NEAR(support[1].plant_hz, second_hz, 1e-9 * second_hz);  // both planes are alike
}

TEST(StartFromRig, NamesEveryUnknownOnceAndHoldsEachByAPrior) {
  const ModalStart& start = PartsStart();
  const std::set<std::string> names(start.names.begin(), start.names.end());
  EXPECT_EQ(names.size(), start.names.size());
  EXPECT_EQ(names.count(""), 0U);
  EXPECT_GT(start.prior.minCoeff(), 0.0);
  EXPECT_EQ(start.names[static_cast<std::size_t>(start.frame.layout.gyroscopic_at(2, 5))],
            "gyroscopic_5_2");  // symmetric: one entry for both places
}

TEST(StartFromRig, RigidModesAreMassNormalised) {
  // A force F at z: acceleration of the rotor at z is F (1/m + (z - zc)^2/It), the sum of squares.
  const Physical rig = PartsNominal(0);
  for (Eigen::Index b = 0; b < 2; ++b) {
    const double arm_m = PartsStart(0).frame.actuator_z_m[b] - rig.centre_z_m;
    EXPECT_NEAR(rig.actuator.col(b).squaredNorm(),
                1.0 / rig.mass_kg + arm_m * arm_m / rig.inertia_kg_m2, 1e-12);
  }
}

}  // namespace
}  // namespace levitas::identification

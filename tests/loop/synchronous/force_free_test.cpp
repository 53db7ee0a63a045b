// "No bearing force and no resonance at any speed, stable without rotor data" (S. Heindel,
// F. Becker, S. Rinderknecht, Mechanical Systems and Signal Processing 85, 2017, 339-353): what is
// true of a Jeffcott rotor, and what of a rotor that bends by itself.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/free_modes.hpp"
#include "common/ellipse.hpp"
#include "common/random.hpp"
#include "design/uncertainty/uncertain_plant.hpp"
#include "tests/loop/synchronous/notch_loop.hpp"

namespace levitas::test {
namespace {

using Complex = std::complex<double>;
using Eigen::Matrix3cd;
using Eigen::Matrix4cd;
using Eigen::Vector4cd;
using synchronous::Target;

constexpr Complex kJ{0.0, 1.0};

/// Disc on a massless shaft, carried by a journal without mass, r = x + jy:
///   m r'' = k (y - r) + m eps w^2 e^{jwt},   k (y - r) = -K e - d e',   e = y - q,
/// K and d the law's, q what a block takes off the position: q' = j w q + rate T e.
struct Jeffcott {
  double mass_kg, shaft_n_per_m, law_n_per_m, law_n_s_per_m;

  [[nodiscard]] double critical() const { return std::sqrt(shaft_n_per_m / mass_kg); }
  [[nodiscard]] Complex BearingAt(double w) const { return law_n_per_m + kJ * w * law_n_s_per_m; }
  /// States r, r', e, q.
  [[nodiscard]] Matrix4cd Loop(double w, Complex t, double rate) const {
    Matrix4cd a = Matrix4cd::Zero();
    a(0, 1) = 1.0;
    a.row(1) << -1.0, 0.0, 1.0, 1.0;
    a.row(1) *= shaft_n_per_m / mass_kg;
    a.row(2) << shaft_n_per_m, 0.0, -(law_n_per_m + shaft_n_per_m), -shaft_n_per_m;
    a.row(2) /= law_n_s_per_m;
    a.row(3) << 0.0, 0.0, rate * t, kJ * w;
    return a;
  }
  /// Growth of the slowest motion; below zero it decays.
  [[nodiscard]] double Slowest(double w, Complex t, double rate) const {
    const Matrix4cd a = Loop(w, t, rate);
    if (rate > 0.0)
      return Eigen::ComplexEigenSolver<Matrix4cd>(a, false).eigenvalues().real().maxCoeff();
    const Matrix3cd alone = a.topLeftCorner<3, 3>();
    return Eigen::ComplexEigenSolver<Matrix3cd>(alone, false).eigenvalues().real().maxCoeff();
  }
  /// What turns with e^{jwt} for an eccentricity of 1.
  [[nodiscard]] Vector4cd Turning(double w, Complex t, double rate) const {
    const Vector4cd unbalance(0.0, w * w, 0.0, 0.0);
    return (kJ * w * Matrix4cd::Identity() - Loop(w, t, rate)).fullPivLu().solve(unbalance);
  }
};

Jeffcott Drawn(Random& draw) {
  const auto decades = [&](double low, double high) {
    return std::pow(10.0, low + (high - low) * draw.Uniform());
  };
  Jeffcott made{decades(-1.0, 1.0), decades(4.0, 6.0), 0.0, 0.0};
  made.law_n_per_m = made.shaft_n_per_m * decades(-1.3, 0.3);
  made.law_n_s_per_m = made.law_n_per_m / made.critical() * decades(-0.7, 0.7);
  return made;
}

TEST(ForceFree, AJeffcottRotorHasNeitherForceNorResonanceAndIsStableWithoutItsData) {
  Random draw(17);
  for (int n = 0; n < 200; ++n) {
    const Jeffcott rotor = Drawn(draw);
    bool plain_unstable = false;
    for (double share = 0.1; share < 5.0; share += 0.1) {
      const double w = share * rotor.critical();
      const double rate = -rotor.Slowest(w, 0.0, 0.0) / 30.0;  // slow beside the loop itself
      const Complex bearing = rotor.BearingAt(w);
      const Complex turned = -kJ * bearing / std::abs(bearing);
      ASSERT_LT(rotor.Slowest(w, turned, rate), 0.0) << "rotor " << n << " at " << share;
      const Vector4cd found = rotor.Turning(w, turned, rate);
      // The disc's centre turns at its eccentricity about the centre of mass, which stands; e is
      // the law's input, and so its force. 1e-6: of the solution of the ill-conditioned critical.
      EXPECT_NEAR(std::abs(found[0] + 1.0), 0.0, 1e-6) << share;
      EXPECT_NEAR(std::abs(found[2]), 0.0, 1e-6) << share;
      plain_unstable = plain_unstable || rotor.Slowest(w, 1.0, rate) > 0.0;
    }
    EXPECT_TRUE(plain_unstable) << "T = 1 harms no speed of rotor " << n;
  }
}

/// The orbit of the rig file's unbalance at the sensors while the bearings give no force of that
/// order but what the magnets' negative stiffness does.
double FreeOrbit(const configuration::RigFile& rig, double speed_rad_per_s) {
  const Eigen::VectorXcd position_m = uncertainty::UncertainPlant(rig, {}, speed_rad_per_s)
                                          .PositionOf(rig.plant.unbalance, speed_rad_per_s);
  return std::max(LargestRadius(position_m[0], position_m[1]),
                  LargestRadius(position_m[2], position_m[3]));
}

configuration::RigFile WithoutMagnets() {
  configuration::RigFile rig = ShippedRig();
  for (auto& bearing : rig.plant.bearings) bearing.magnet.force_constant_n_m2_per_a2 *= 1e-9;
  return rig;
}

struct Peak {
  double rpm{};
  double orbit_m{};
};

Peak PeakOf(const configuration::RigFile& rig) {
  Peak peak;
  for (double rpm = 4500.0; rpm <= 6600.0; rpm += 5.0) {
    const double orbit_m = FreeOrbit(rig, RpmToRadPerS(rpm));
    if (orbit_m > peak.orbit_m) peak = {rpm, orbit_m};
  }
  return peak;
}

/// Where the first forward whirl of the free rotor turns as fast as the rotor.
double FreeCriticalRpm() {
  double rpm = 5400.0;
  for (int i = 0; i < 20; ++i) {
    const auto modes = analysis::ComputeFreeModes(ShippedRig().plant, {RpmToRadPerS(rpm)}, 1);
    rpm = 60.0 * modes.whirl.front().forward_hz.front();
  }
  return rpm;
}

TEST(ForceFree, ARotorThatBendsByItselfIsAtItsResonanceWhenNoBearingHoldsIt) {
  const double clearance_m = ShippedRig().numbers.ClearanceOf(0);
  const Peak no_force = PeakOf(WithoutMagnets());
  const Peak no_current = PeakOf(ShippedRig());
  EXPECT_GT(no_force.orbit_m, 3.0 * clearance_m);
  EXPECT_GT(no_current.orbit_m, 3.0 * clearance_m);
  EXPECT_NEAR(no_force.rpm, FreeCriticalRpm(), 10.0);  // two steps of the search
  EXPECT_LT(no_current.rpm, no_force.rpm - 100.0);     // negative springs make it softer
  RecordProperty("no_force_rpm", std::to_string(no_force.rpm));
  RecordProperty("no_force_um", std::to_string(1e6 * no_force.orbit_m));
  RecordProperty("no_current_rpm", std::to_string(no_current.rpm));
  RecordProperty("no_current_um", std::to_string(1e6 * no_current.orbit_m));
}

// Of the motion that resonates, the bearings' forces must take away what the unbalance drives it
// with, whatever the law: F with u^H (G F + D) = 0, u the direction that G amplifies most.
TEST(ForceFree, NoLawHoldsThatResonanceWithLessThanHalfOfWhatTheUnbalancePulls) {
  const configuration::RigFile rig = WithoutMagnets();
  const double speed = RpmToRadPerS(FreeCriticalRpm());
  const uncertainty::UncertainPlant plant(rig, {}, speed);
  const double hz = speed / (2.0 * std::numbers::pi);
  Eigen::MatrixXcd by_force(4, 4);
  for (Eigen::Index b = 0; b < 2; ++b) {
    const double z_m = rig.plant.bearings[static_cast<std::size_t>(b)].actuator_z_m;
    by_force.col(2 * b) = plant.PositionOf(hz, z_m, 1.0, 0.0);
    by_force.col(2 * b + 1) = plant.PositionOf(hz, z_m, 0.0, 1.0);
  }
  const Eigen::VectorXcd by_unbalance_m = plant.PositionOf(rig.plant.unbalance, speed);
  const Eigen::JacobiSVD<Eigen::MatrixXcd> svd(by_force, Eigen::ComputeThinU);
  // Amplitudes of x and of y: a force that turns has the size of each times the root of two.
  const double least_n = std::abs(svd.matrixU().col(0).dot(by_unbalance_m)) /
                         svd.singularValues()[0] / std::numbers::sqrt2;
  double unbalance_n = 0.0;
  for (const auto& mass : rig.plant.unbalance) unbalance_n += mass.moment_kg_m * speed * speed;
  EXPECT_GT(least_n, 0.5 * unbalance_n);
  RecordProperty("least_n", std::to_string(least_n));
  RecordProperty("unbalance_n", std::to_string(unbalance_n));
}

design::NotchRequest OfBearings(Target target, double rpm, double time_constant_s) {
  auto request = Asked(target, rpm - 50.0, rpm + 50.0, time_constant_s);
  request.knowledge = design::Knowledge::kBearings;
  return request;
}

TEST(ForceFree, ThereItDrivesTheRotorIntoContactAndBearingsThatHoldItDoNot) {
  constexpr double kRpm = 5300.0;
  ClosedLoop harmed(Unwatched(WithBlock(OfBearings(Target::kCurrent, kRpm, 0.1))));
  EXPECT_TRUE(TouchesAt(harmed, kRpm));

  const cycle::CycleConfig vibration = WithBlock(OfBearings(Target::kVibration, kRpm, 0.1));
  for (const auto& config : {CommissionedCycle(), vibration}) {
    ClosedLoop held(Unwatched(config));
    ASSERT_TRUE(TurnsAt(held, kRpm, 20.0));
    EXPECT_EQ(held.out.fault, Fault::kNone);
    EXPECT_EQ(held.most.contact_n, 0.0);
    EXPECT_LT(held.most.orbit_m, 36e-6);  // the objective of the rig
  }
}

}  // namespace
}  // namespace levitas::test

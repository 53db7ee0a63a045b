// Supports and stability: what effects do to poles and to contact.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <complex>

#include "common/two_pi.hpp"
#include "numerics/dense/eigenvalues.hpp"
#include "plant_sim/plant/linear_model.hpp"
#include "plant_sim/plant/time_step.hpp"
#include "tests/loop/effects/effect_rig.hpp"

namespace levitas::plant::test {
namespace {

using effect::Id;

/// The pole of the free rotor (no magnets) nearest to j w.
std::complex<double> PoleNear(const effect::EffectConfig& entry, double w, double speed_rad_per_s) {
  PlantParameters parameters = Quiet()->parameters();
  parameters.config.effects.push_back(entry);
  for (auto& b : parameters.config.bearings) b.magnet.bias_current_a = 1e-9;
  const LinearModel linear = Linearise(PlantModel(parameters), speed_rad_per_s);
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(linear.a, false);
  std::complex<double> nearest = 1e300;
  for (const auto& pole : solver.eigenvalues()) {
    const std::complex<double> wanted(0.0, w);
    if (std::abs(pole - wanted) < std::abs(nearest - wanted)) nearest = pole;
  }
  return nearest;
}

TEST(InternalDamping, DampsBelowAndDestabilisesAboveTheThresholdSpeed) {
  constexpr double kZ_m = 0.23;
  constexpr double kDamping = 20.0;
  const double w = Quiet()->frequency()[2];
  const double zeta = Quiet()->damping_ratio()[2];
  // Without gyroscopic effect one bending mode: W* = w (1 + 2 zeta w/(d phi^2)).
  PlantParameters still = Quiet()->parameters();
  still.modes.gyroscopic.setZero();
  still.config.effects = {Entry(Id::kInternalDamping, {kZ_m, kDamping})};
  for (auto& b : still.config.bearings) b.magnet.bias_current_a = 1e-9;
  const PlantModel model(still);
  const double phi = model.effects().dampers[0].shape[2];
  const double threshold = w * (1.0 + 2.0 * zeta * w / (kDamping * phi * phi));
  const auto growth = [&](double speed) {
    const Eigen::EigenSolver<Eigen::MatrixXd> solver(Linearise(model, speed).a, false);
    double most = -1e300;
    for (const auto& pole : solver.eigenvalues()) {
      if (std::abs(std::abs(pole.imag()) - w) < 0.05 * w) most = std::max(most, pole.real());
    }
    return most;
  };
  // The other modes shift this one by their coupling through the damper, of order d^2: below 1 %.
  EXPECT_LT(growth(0.99 * threshold), 0.0);
  EXPECT_GT(growth(1.01 * threshold), 0.0);
}

TEST(CrossCoupledStiffness, IfPositiveTakesDampingFromForwardWhirlAndGivesItToBackward) {
  constexpr double kZ_m = 0.23;
  constexpr double kKq = 100.0;
  const auto model = QuietWith(Entry(Id::kCrossCoupledStiffness, {kZ_m, kKq}));
  const double phi = model->effects().springs[0].shape[2];
  const double w = Quiet()->frequency()[2];
  const auto entry = Entry(Id::kCrossCoupledStiffness, {kZ_m, kKq});
  // At rest both whirls lie at w: s^2 + 2 zeta w s + w^2 -+ j kq phi^2 = 0 splits their real parts
  // by +- kq phi^2/(2 w), which is zeta = (c w - kq)/(2 m w^2) of forward whirl with m = 1/phi^2;
  // the nearest pole to j w is one of them, its partner the other.
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(
      [&] {
        PlantParameters parameters = Quiet()->parameters();
        parameters.config.effects.push_back(entry);
        for (auto& b : parameters.config.bearings) b.magnet.bias_current_a = 1e-9;
        return Linearise(PlantModel(parameters), 0.0).a;
      }(),
      true);
  const double nominal = -Quiet()->damping_ratio()[2] * w;
  int seen = 0;
  for (Eigen::Index i = 0; i < solver.eigenvalues().size(); ++i) {
    const std::complex<double> pole = solver.eigenvalues()[i];
    if (std::abs(pole.imag() - w) > 0.01 * w) continue;
    ++seen;
    // Whirl direction from the mode shape: forward has y = -j x (for e^{+j w t}).
    const std::complex<double> x = solver.eigenvectors()(2, i);
    const std::complex<double> y = solver.eigenvectors()(10, i);
    const bool forward = (y / x).imag() < 0.0;
    const double expected = nominal + (forward ? 1.0 : -1.0) * kKq * phi * phi / (2.0 * w);
    // Second order in kq: (kq phi^2)^2/(8 w^3) and coupling to other modes, below 1 % of the shift.
    EXPECT_NEAR(pole.real(), expected, 0.01 * kKq * phi * phi / (2.0 * w));
  }
  EXPECT_EQ(seen, 2);
}

TEST(SupportMode, AddsAPairOfModesAtTheFrequencyOfTheHousing) {
  // Without current in the magnets nothing couples the housing to the rotor.
  const double w = kTwoPi * 160.0;
  const auto pole = PoleNear(Entry(Id::kSupportMode, {5.0, 160.0, 0.02}), w, 0.0);
  EXPECT_NEAR(pole.real(), -0.02 * w, 1e-6 * w);
  EXPECT_NEAR(pole.imag(), w * std::sqrt(1.0 - 0.02 * 0.02), 1e-6 * w);
}

TEST(SupportMode, MovesMagnetAndSensorTogetherSoThatTheReadingIsRelative) {
  Plant plant(QuietWith(Entry(Id::kSupportMode, {5.0, 160.0, 0.0})), 1);
  plant.RestInTouchdown();
  const std::size_t housing = plant.model().effects().bearings[0].housing_state;
  plant.mutable_state()[housing] = 10e-6;
  PlantCommand off;
  off.amplifiers_enabled = false;
  for (int i = 1; i <= 100; ++i) {
    plant.Advance(off);
    // Free oscillation without force; actuator and sensor see its opposite.
    const double u_m = 10e-6 * std::cos(kTwoPi * 160.0 * i * 1e-4);
    EXPECT_NEAR(plant.state()[housing], u_m, 1e-15);
    EXPECT_NEAR(plant.ActuatorPosition()[0], -u_m, 1e-15);
    EXPECT_NEAR(plant.ActuatorPosition()[2], 0.0, 1e-18);
  }
}

TEST(SupportMode, FeelsTheOppositeOfTheForceOnTheRotor) {
  constexpr double kMass_kg = 5.0;
  PlantParameters parameters = Quiet()->parameters();
  parameters.config.effects = {Entry(Id::kSupportMode, {kMass_kg, 0.1, 0.0}),
                               Entry(Id::kSupportMode, {kMass_kg, 0.1, 0.0})};
  parameters.config.effects[1].bearing = 1;
  Plant plant(std::make_shared<const PlantModel>(parameters), 1);
  PlantCommand command;
  command.bias_current_a = 1.0;
  command.control_current_a = {0.2, 0.0, 0.0, 0.0};
  for (int i = 0; i < 20; ++i) plant.Advance(command);
  // Momentum of rotor and both housings stays zero but for their soft springs: (w t)^2/6 of it.
  const auto& at = plant.layout();
  const auto& rigid = plant.model().rigid();
  double rotor = 0.0;  // translation's momentum: sum of velocity times unit translation
  for (std::size_t i = 0; i < 2; ++i) {
    rotor += plant.state()[at.v_x + i] * rigid(static_cast<Eigen::Index>(i), 0);
  }
  double frame = 0.0;
  for (const BearingEffects& bearing : plant.model().effects().bearings) {
    frame += kMass_kg * plant.state()[bearing.housing_state + 2];
  }
  EXPECT_GT(rotor, 1e-3);  // 8 N for some 2 ms
  EXPECT_NEAR((rotor + frame) / rotor, 0.0, 1e-5);
}

TEST(TouchdownRub, PushesBackBeyondItsClearanceAgainstRotationAndNotBelowIt) {
  constexpr double kClearance_m = 20e-6;
  constexpr double kStiffness = 2e5;
  constexpr double kFriction = 0.1;
  auto rig = Quiet()->parameters();
  rig.config.bearings[0].touchdown.journal_radius_m = 0.012;
  rig.config.effects.push_back(
      Entry(Id::kTouchdownRub, {kClearance_m, kStiffness, 0.0, kFriction}));
  const PlantModel model(rig);
  const auto force_at = [&](double x_m) {
    Plant plant(std::make_shared<const PlantModel>(rig), 1);
    plant.PlaceAtRest({x_m, 0.0, x_m, 0.0});
    std::vector<double> acceleration(16);
    ForceReport report;
    const Rotation rotation{300.0, 0.0, 0.0};
    ModalForces(model, {}, MakeSpin(rotation, MakeHeading(rotation)), plant.state().data(),
                plant.state().data() + plant.layout().v_x, acceleration.data(), report);
    return report.bearing_n;
  };
  EXPECT_EQ(force_at(19e-6)[0], 0.0);
  const AxisArray force_n = force_at(30e-6);
  EXPECT_NEAR(force_n[0], -kStiffness * 10e-6, 1e-9);
  // Journal surface moves towards +y at 3.6 m/s: friction pulls towards -y; smoothing below 1e-5.
  EXPECT_NEAR(force_n[1], -kFriction * kStiffness * 10e-6, 1e-5);
  EXPECT_EQ(force_n[2], 0.0);  // the other bearing has no ring
}

}  // namespace
}  // namespace levitas::plant::test

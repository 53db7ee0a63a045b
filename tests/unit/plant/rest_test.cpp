// Where a rotor lies that does not move: statics in closed form.

#include "plant_sim/plant/rest.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "plant_sim/plant/time_step.hpp"
#include "tests/support/geared_rigs.hpp"
#include "tests/support/test_rigs.hpp"

namespace levitas::plant {
namespace {

constexpr double kUntouched = 7.0;

/// A state in which everything that a placement may not touch can be recognised.
std::vector<double> Marked(const PlantModel& model) {
  return std::vector<double>(model.layout().size, kUntouched);
}

/// Displacement at the actuator plane of a bearing: x, or y.
double At(const PlantModel& model, const std::vector<double>& state, std::size_t bearing,
          std::size_t plane) {
  const double* modal = state.data() + (plane == 0 ? model.layout().q_x : model.layout().q_y);
  return AtPlane(model.bearings()[bearing].actuator_shape, modal);
}

TEST(PlaceRigidly, BringsBothBearingsOfAStraightShaftWhereTheyAreWanted) {
  const PlantModel model(test::FlexibleRotor());
  std::vector<double> state = Marked(model);
  const AxisArray wanted_m{30e-6, -10e-6, 50e-6, 20e-6};
  PlaceRigidly(model, wanted_m, state);
  for (std::size_t axis = 0; axis < 4; ++axis) {
    // Of shapes from finite elements: to their rounding.
    EXPECT_NEAR(At(model, state, axis / 2, axis % 2), wanted_m[axis], 1e-12) << axis;
  }
}

TEST(PlaceRigidly, BringsTheBearingsOfGearedShaftsWhereTheyAreWanted) {
  const PlantModel model(test::GearedRotor8());
  std::vector<double> state = Marked(model);
  const AxisArray wanted_m{30e-6, -10e-6, 50e-6, 20e-6};
  PlaceRigidly(model, wanted_m, state);
  for (std::size_t axis = 0; axis < 4; ++axis) {
    EXPECT_NEAR(At(model, state, axis / 2, axis % 2), wanted_m[axis], 1e-12) << axis;
  }
}

TEST(PlaceRigidly, WritesDisplacementsAndNothingElse) {
  const PlantModel model(test::FlexibleRotor());
  std::vector<double> state = Marked(model);
  PlaceRigidly(model, {}, state);
  const StateLayout& at = model.layout();
  std::size_t written = 0;
  for (std::size_t i = 0; i < state.size(); ++i) {
    const bool displacement =
        (i >= at.q_x && i < at.q_x + at.modes) || (i >= at.q_y && i < at.q_y + at.modes);
    EXPECT_EQ(state[i], displacement ? 0.0 : kUntouched) << i;
    written += displacement ? 1 : 0;
  }
  EXPECT_EQ(written, 2 * at.modes);
}

TEST(PlaceInTouchdown, WithoutGravityIsTheCentre) {
  PlantConfig config = test::FlexibleRotor();
  config.gravity_m_per_s2 = 0.0;
  const PlantModel model(config);
  std::vector<double> state = Marked(model);
  PlaceInTouchdown(model, state);
  for (std::size_t axis = 0; axis < 4; ++axis) {
    EXPECT_EQ(At(model, state, axis / 2, axis % 2), 0.0) << axis;
  }
}

TEST(PlaceInTouchdown, WithABearingThatHasNoneIsTheCentre) {
  PlantConfig config = test::FlexibleRotor();
  config.bearings[1].touchdown = {};
  const PlantModel model(config);
  std::vector<double> state = Marked(model);
  PlaceInTouchdown(model, state);
  for (std::size_t axis = 0; axis < 4; ++axis) {
    EXPECT_EQ(At(model, state, axis / 2, axis % 2), 0.0) << axis;
  }
}

// What the bearings are pressed in carries the weight, in force and in moment, and pulls along
// gravity.
TEST(PlaceInTouchdown, PressesTheRotorInByItsWeightInSumAndInMoment) {
  for (const double direction_deg : {225.0, 270.0, 10.0}) {
    PlantConfig config = test::FlexibleRotor();
    config.gravity_direction_rad = direction_deg * std::numbers::pi / 180.0;
    const PlantModel model(config);
    std::vector<double> state = Marked(model);
    PlaceInTouchdown(model, state);
    double force_n = 0.0;
    double moment_n_m = 0.0;
    for (std::size_t b = 0; b < 2; ++b) {
      const double x_m = At(model, state, b, 0);
      const double y_m = At(model, state, b, 1);
      EXPECT_NEAR(std::remainder(std::atan2(y_m, x_m) - config.gravity_direction_rad,
                                 2.0 * std::numbers::pi),
                  0.0, 1e-9);
      const TouchdownConfig& touchdown = config.bearings[b].touchdown;
      const double pressed_n =
          touchdown.stiffness_n_per_m * (std::hypot(x_m, y_m) - touchdown.clearance_m);
      force_n += pressed_n;
      moment_n_m += pressed_n * config.bearings[b].actuator_z_m;
    }
    // Mass and its centre from the description: a uniform shaft and three discs.
    const rotor::RotorConfig& rotor = config.rotor;
    const rotor::Section& shaft = rotor.sections[0];
    double mass_kg = rotor.material.density_kg_per_m3 * shaft.length_m * 0.25 * std::numbers::pi *
                     std::pow(shaft.outer_diameter_m, 2);
    double first_kg_m = mass_kg * 0.5 * shaft.length_m;
    for (const auto& disc : rotor.discs) {
      mass_kg += disc.mass_kg;
      first_kg_m += disc.mass_kg * disc.z_m;
    }
    EXPECT_NEAR(force_n, 9.81 * mass_kg, 1e-6 * force_n);
    EXPECT_NEAR(moment_n_m, 9.81 * first_kg_m, 1e-6 * moment_n_m);
  }
}

}  // namespace
}  // namespace levitas::plant

// PIDs of translation and tilt: the coordinates against statics, the law between the axes against
// the channels step by step, the search's reading of it against analysis.
#include "design/pid/coordinates.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "analysis/sensitivity.hpp"
#include "common/problem.hpp"
#include "common/random.hpp"
#include "common/rotational_speed.hpp"
#include "controller/law/axis_law.hpp"
#include "design/pid/pid_search.hpp"
#include "plant_sim/plant/linear_parts.hpp"
#include "plant_sim/plant/plant_model.hpp"
#include "tests/loop/design/survey_against_analysis.hpp"
#include "tests/support/shipped_loop.hpp"

namespace levitas::design {
namespace {

configuration::RigFile FlexibleRotor() {
  return configuration::LoadRig(configuration::FindConfig("flexible_rotor", "rigs"));
}

/// First moment over mass of sections and discs as the rig file gives them.
double CentreOfMass(const rotor::RotorConfig& rotor) {
  double mass = 0.0;
  double moment = 0.0;
  double z = 0.0;
  for (const auto& section : rotor.sections) {
    const double area = std::numbers::pi / 4.0 *
                        (section.outer_diameter_m * section.outer_diameter_m -
                         section.inner_diameter_m * section.inner_diameter_m);
    const double of_section = rotor.material.density_kg_per_m3 * area * section.length_m;
    moment += of_section * (z + 0.5 * section.length_m);
    mass += of_section;
    z += section.length_m;
  }
  for (const auto& disc : rotor.discs) {
    moment += disc.mass_kg * disc.z_m;
    mass += disc.mass_kg;
  }
  return moment / mass;
}

TEST(TranslationAndTilt, ReadsAShiftAsTranslationAndATurnAboutTheCentreOfMassAsTilt) {
  const auto rig = FlexibleRotor();
  const auto coordinates = TranslationAndTilt(rig);
  const double centre = CentreOfMass(rig.plant.rotor);
  Eigen::Vector4d shifted = Eigen::Vector4d::Zero();
  Eigen::Vector4d turned = Eigen::Vector4d::Zero();
  for (const Eigen::Index b : {0, 1}) {
    shifted[2 * b] = 1.0;
    turned[2 * b] = rig.plant.bearings[static_cast<std::size_t>(b)].sensor_z_m - centre;
  }
  EXPECT_LT((coordinates.measure * shifted - Eigen::Vector4d(1, 0, 0, 0)).norm(), 1e-12);
  const Eigen::Vector4d tilt = coordinates.measure * turned;
  EXPECT_NEAR(tilt[0], 0.0, 1e-9);
  EXPECT_GT(tilt[2], 0.1);
}

TEST(TranslationAndTilt, DrivesAForceWithoutAMomentAndAMomentWithoutAForce) {
  auto rig = FlexibleRotor();
  rig.plant.bearings[1].magnet.bias_current_a *= 0.7;  // unlike ki
  const auto coordinates = TranslationAndTilt(rig);
  const plant::PlantModel model(rig.plant);
  const double centre = CentreOfMass(rig.plant.rotor);
  const auto of = [&](Eigen::Index channel) {
    double force = 0.0;
    double moment = 0.0;
    for (const std::size_t b : {0U, 1U}) {
      const double one = plant::SlopesAtCentre(model, b).current(0, 0) *
                         coordinates.drive(2 * static_cast<Eigen::Index>(b), channel);
      force += one;
      moment += one * (rig.plant.bearings[b].actuator_z_m - centre);
    }
    return std::pair(force, moment);
  };
  const auto [push, push_moment] = of(0);
  const auto [turn_force, turn] = of(2);
  EXPECT_GT(push, 10.0);
  EXPECT_NEAR(push_moment, 0.0, 1e-9 * push);
  EXPECT_GT(turn, 1.0);
  EXPECT_NEAR(turn_force, 0.0, 1e-9 * turn);
}

TEST(TranslationAndTilt, AreRefusedForAnotherRig) {
  for (const char* name : {"geared_rotor_4dof", "one_axis"})
    EXPECT_THROW(static_cast<void>(TranslationAndTilt(
                     configuration::LoadRig(configuration::FindConfig(name, "rigs")))),
                 Problem)
        << name;
  auto overhung = FlexibleRotor();
  overhung.plant.rotor.discs.push_back({0.0, 500.0, 1.0, 1.0});
  EXPECT_THROW(static_cast<void>(TranslationAndTilt(overhung)), Problem);
}

/// Gains and filters drawn around what levitates, of translation and of tilt.
law::LawConfig Drawn(const configuration::RigFile& rig, Random& draw) {
  LawShape shape;
  shape.bearings = 2;
  shape.axes = 4;
  shape.own_filters = true;
  shape.period_s = rig.numbers.period_s();
  shape.current_limit_a = 1e9;
  PlainGains gains;
  gains.notch_hz = {400.0, 900.0};
  for (int channel = 0; channel < 2; ++channel) {
    gains.kp_a_per_m.push_back(2500.0 * (1.0 + std::exp(draw.Normal() - 0.5)));
    gains.kd_a_s_per_m.push_back(gains.kp_a_per_m.back() * 2e-3 * std::exp(draw.Normal()));
  }
  Eigen::VectorXd x = StartAt(shape, gains);
  for (Eigen::Index i = 5; i < x.size(); ++i) x(i) += 0.3 * draw.Normal();
  return LawAt(shape, x);
}

TEST(BetweenAxes, CommandsWhatTheChannelsCommandPeriodByPeriod) {
  const auto rig = FlexibleRotor();
  const auto coordinates = TranslationAndTilt(rig);
  Random draw(11);
  for (int n = 0; n < 5; ++n) {
    const auto channels = Drawn(rig, draw);
    const law::LawCoefficients one(channels);
    const law::LawCoefficients other(BetweenAxes(channels, coordinates));
    law::LawState channel_state(one);
    law::LawState axis_state(other);
    double most = 0.0;
    double apart = 0.0;
    for (int k = 0; k < 3000; ++k) {
      AxisArray error{};
      Eigen::Vector4d e;
      for (Eigen::Index i = 0; i < 4; ++i)
        error[static_cast<std::size_t>(i)] = e[i] = 1e-5 * draw.Normal();
      const Eigen::Vector4d seen = coordinates.measure * e;
      AxisArray channel_error{};
      for (Eigen::Index i = 0; i < 4; ++i) channel_error[static_cast<std::size_t>(i)] = seen[i];
      const auto of_channels = law::Step(one, channel_state, channel_error, {}, 1e9);
      const auto of_axes = law::Step(other, axis_state, error, {}, 1e9);
      Eigen::Vector4d wanted;
      for (Eigen::Index i = 0; i < 4; ++i)
        wanted[i] = of_channels.control_current_a[static_cast<std::size_t>(i)];
      const Eigen::Vector4d currents = coordinates.drive * wanted;
      for (Eigen::Index i = 0; i < 4; ++i) {
        most = std::max(most, std::abs(currents[i]));
        apart = std::max(
            apart, std::abs(currents[i] - of_axes.control_current_a[static_cast<std::size_t>(i)]));
      }
    }
    EXPECT_GT(most, 0.01);
    EXPECT_LT(apart, 1e-7 * most) << "draw " << n;
  }
}

TEST(SurveyOfChannels, AgreesWithEigenvaluesAndPeaksOfTheLawBetweenTheAxes) {
  const auto rig = FlexibleRotor();
  const auto coordinates = TranslationAndTilt(rig);
  Random draw(5);
  int stable = 0;
  for (const double speed : {0.0, rig.numbers.max_speed_rad_per_s}) {
    const SampledPlant plant(rig, speed, Known::kAll, coordinates);
    for (int n = 0; n < 20; ++n) {
      const auto channels = Drawn(rig, draw);
      std::vector<law::DiscreteLaw> laws;
      for (const auto& one : channels.axes) laws.push_back(law::Discretise(one, channels.period_s));
      const auto survey = Survey(plant, laws, std::vector<double>(4, 1e-6));
      const auto exact =
          analysis::SensitivityPeaks(rig.plant, BetweenAxes(channels, coordinates), speed);
      if (ExpectAsAnalysisSays(survey, exact, std::to_string(speed) + " draw " + std::to_string(n)))
        ++stable;
    }
  }
  EXPECT_GT(stable, 5);
}

// The nonlinear rig, every speed on the way; and what decoupling buys for the same search.
TEST(PidDesignOfTranslationAndTilt, RunsTheRigUpWithALowerPeakThanTheAxesAlone) {
  const auto rig = FlexibleRotor();
  PidSearchOptions options;
  options.evaluations = 1500;
  options.corners = 2;
  options.current_limit_a = 1.0;
  const auto limits = UsualLimits(rig, options.current_limit_a);
  const auto search = [&] {
    return SearchPid(rig, limits, uncertainty::Stated(rig, {}), options,
                     [](double, const std::string&) { return true; });
  };
  const auto of_axes = search();
  options.coordinates = TranslationAndTilt(rig);
  const auto of_channels = search();
  EXPECT_LE(of_channels.figures[Limiting(of_channels.figures)].ratio, 1.0);
  EXPECT_LT(of_channels.figures[Limit::kSensitivity].found,
            0.95 * of_axes.figures[Limit::kSensitivity].found);
  test::ShippedLoop loop("flexible_rotor", "run_up_6000");
  loop.controller.law = BetweenAxes(of_channels.law, options.coordinates);
  EXPECT_EQ(loop.Play(1, 60.0), "");
  EXPECT_GT(loop.most.speed_rad_per_s, RpmToRadPerS(5950.0));
  EXPECT_EQ(loop.most.contact_n, 0.0);
}

}  // namespace
}  // namespace levitas::design

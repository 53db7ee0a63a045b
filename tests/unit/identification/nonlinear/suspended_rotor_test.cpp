#include <gtest/gtest.h>

#include <random>

#include "common/problem.hpp"
#include "configuration/rig_file.hpp"
#include "identification/nonlinear/suspended_rotor_fit.hpp"
#include "plant_sim/magnet/magnet.hpp"
#include "plant_sim/plant/plant_model.hpp"

namespace levitas::identification {
namespace {

using Index = Eigen::Index;

/// 2 kg in one bearing: 40 N/A, i0 = 1 A, s0 = 0.4 mm; x and y alike.
SuspendedRotor OneBearing() {
  SuspendedRotor model;
  model.period_s = 1e-4;
  const RotorMode rigid{0.0, 0.0, Eigen::VectorXd::Ones(1), Eigen::VectorXd::Constant(1, 20.0)};
  for (auto& plane : model.plane) plane = {rigid};
  model.axis.assign(2, {1000.0, 1.0, 0.4e-3, 0.0, 0.0, Eigen::VectorXd::Zero(2)});
  model.sensor.resize(2);
  return model;
}

/// PD with a random excitation, held for 20 samples, at the reading.
LoopAtRest Loop(Index rows, double sign = 1.0) {
  std::mt19937_64 draw(20261122);
  std::uniform_real_distribution<double> level(-40e-6, 40e-6);
  Eigen::MatrixXd excitation_m(rows, 2);
  for (Index k = 0; k < rows; ++k) {
    for (Index a = 0; a < 2; ++a) {
      excitation_m(k, a) = k % 20 == 0 ? level(draw) : excitation_m(k - 1, a);
    }
  }
  return [excitation_m, sign] {
    return [excitation_m, sign, last = Eigen::Vector2d::Zero().eval()](
               Index k, const Eigen::VectorXd& y, Eigen::VectorXd& u) mutable {
      const Eigen::Vector2d seen = y + excitation_m.row(k).transpose();
      u = -sign * (6000.0 * seen + 12.0 * (seen - last) / 1e-4);
      last = seen;
    };
  };
}

Series RecordOf(const SuspendedRotor& model, Index rows) {
  const Prediction run = RunFree(model, rows, Loop(rows)());
  EXPECT_FALSE(run.diverged_at.has_value());
  return {model.period_s, {}, {}, Eigen::MatrixXd(rows, 0), run.output};
}

TEST(AxisForce, WithStraightIronIsTheForceOfTwoOpposedCoilsOverKi) {
  const AxisForce force{2500.0, 1.5, 0.25e-3, 0.0, 0.0, Eigen::VectorXd::Zero(3)};
  const magnet::Magnet magnet{
      .force_constant_n_m2_per_a2 = 1e-6, .gap_m = 0.25e-3, .max_coil_current_a = 3.0};
  const double ki_n_per_a = magnet::ForcePerCurrent(magnet, 1.5);
  for (const double current_a : {-1.2, -0.3, 0.0, 0.7}) {
    for (const double x_m : {-60e-6, 0.0, 25e-6}) {
      EXPECT_NEAR(force.At(current_a, x_m), magnet::Force(magnet, 1.5, current_a, x_m) / ki_n_per_a,
                  1e-12);
    }
  }
}

TEST(SuspendedRotor, FallsWithoutItsLoop) {
  SuspendedRotor model = OneBearing();
  model.axis[0].offset_a = 0.01;
  const Prediction run =
      RunFree(model, 5000, [](Index, const Eigen::VectorXd&, Eigen::VectorXd& u) { u.setZero(); });
  EXPECT_TRUE(run.diverged_at.has_value());
}

TEST(SuspendedRotor, FitFindsWhatADesignDoesNotSay) {
  SuspendedRotor truth = OneBearing();
  truth.plane[0][0].in *= 0.85;
  truth.axis[0] = {800.0, 1.0, 0.37e-3, 0.02, 0.05, Eigen::Vector2d(0.0, -0.2)};
  const Index rows = 6000;
  const SuspendedRotorFit fit =
      FitSuspendedRotor(OneBearing(), RecordOf(truth, rows), Loop(rows), {.skip = 1000});
  EXPECT_GT(fit.rms_before_m, 1e-8);
  EXPECT_LT(fit.rms_after_m, 0.01 * fit.rms_before_m);
  EXPECT_NEAR(fit.model.axis[0].amplifier_hz, 800.0, 8.0);
  EXPECT_NEAR(fit.model.axis[1].amplifier_hz, 1000.0, 10.0);
  // Small forces: what remains of the scale of all is shared by gap and curve, their product is
  // told: ki by dh/di, ks by dh/dx.
  const auto slopes = [](const SuspendedRotor& model) {
    const AxisForce& force = model.axis[0];
    const double in = model.plane[0][0].in[0];
    return Eigen::Vector2d(in * (force.At(0.01, 0.0) - force.At(-0.01, 0.0)) / 0.02,
                           in * (force.At(0.0, 1e-6) - force.At(0.0, -1e-6)) / 2e-6);
  };
  EXPECT_LT((slopes(fit.model) - slopes(truth)).cwiseQuotient(slopes(truth)).cwiseAbs().maxCoeff(),
            0.01);
}

TEST(SuspendedRotor, FitRefusesALoopThatDoesNotHoldTheStart) {
  const Index rows = 6000;
  try {
    (void)FitSuspendedRotor(OneBearing(), RecordOf(OneBearing(), rows), Loop(rows, -1.0),
                            {.skip = 1000});
    FAIL();
  } catch (const BadInput& problem) {
    EXPECT_NE(std::string(problem.what()).find("signs must be those of the record"),
              std::string::npos);
  }
}

TEST(SuspendedRotor, FitRefusesARecordThatEndsBeforeItJudges) {
  EXPECT_THROW((void)FitSuspendedRotor(OneBearing(), RecordOf(OneBearing(), 1000), Loop(1000),
                                       {.skip = 1000}),
               BadInput);
}

TEST(SuspendedRotor, DesignOfThePumpHasItsMagnetsAndModes) {
  const auto rig = configuration::LoadRig(configuration::FindConfig("turbomolecular_pump", "rigs"));
  const SuspendedRotor model = DesignOf(plant::Reduce(rig.plant), 3);
  ASSERT_EQ(model.axes(), 4);
  ASSERT_EQ(model.plane[0].size(), 3U);
  EXPECT_NEAR(model.plane[0].back().frequency_hz, 561.0, 1e-6);
  EXPECT_NEAR(model.plane[1].back().damping_ratio, 0.004, 1e-9);
  // ki/m + (lever)^2 ki/I of a force at the upper bearing, felt there; and the bending mode's.
  double per_ampere = 0.0;
  for (const RotorMode& mode : model.plane[0]) per_ampere += mode.out[0] * mode.in[0];
  const double lever_m = 79.2e-3;
  EXPECT_NEAR(per_ampere,
              104.4 * (1.0 / 3.013 + lever_m * lever_m / 0.02977 + 1.018 * 1.018 / 3.013),
              1e-3 * per_ampere);
}

TEST(SuspendedRotor, SensorsAwayFromTheMagnetsAreRefused) {
  const auto rig = configuration::LoadRig(configuration::FindConfig("flexible_rotor", "rigs"));
  try {
    (void)DesignOf(plant::Reduce(rig.plant), 3);
    FAIL();
  } catch (const BadInput& problem) {
    EXPECT_NE(std::string(problem.what()).find("bearing de: sensor_z_mm = 109.9"),
              std::string::npos)
        << problem.what();
  }
}

}  // namespace
}  // namespace levitas::identification

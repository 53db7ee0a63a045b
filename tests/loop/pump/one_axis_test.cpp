// The one-axis rig: one coordinate, one coil pair, and nothing that a pencil could not check.

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

#include "analysis/poles.hpp"
#include "analysis/records/observer.hpp"
#include "analysis/sensitivity.hpp"
#include "numerics/dense/eigenvalues.hpp"
#include "plant_sim/plant/linear_model.hpp"
#include "plant_sim/plant/plant_model.hpp"
#include "tests/support/shipped_loop.hpp"

namespace levitas::test {
namespace {

ShippedLoop OneAxis() { return ShippedLoop("one_axis", "one_axis"); }

TEST(OneAxis, HasOneChannelAndOneMode) {
  const ShippedLoop loop = OneAxis();
  EXPECT_EQ(loop.rig.numbers.channels, std::vector<std::string>{"mass_x"});
  const plant::PlantModel model(loop.rig.plant);
  EXPECT_EQ(model.channels(), 1U);
  EXPECT_EQ(model.layout().modes, 1U);
  EXPECT_EQ(plant::Plant(loop.rig.plant, 1).Sample().axes, 1U);
}

TEST(OneAxis, LevitatesThroughItsScenario) {
  ShippedLoop loop = OneAxis();
  EXPECT_EQ(loop.Play(20261121, 20.0), "");
  EXPECT_EQ(loop.most.contact_n, 0.0);
  EXPECT_EQ(loop.most.excitation_a, 0.1);
  EXPECT_NEAR(loop.most.excitation_m, 3e-6, 1e-9);  // the peak of a sampled sine
}

// An unknown force across the guide would never be seen, and the observer never settled.
TEST(OneAxis, IsObservedInItsOneChannelAndSettles) {
  for (const char* name : {"one_axis", "two_magnet_levitator"}) {
    const ShippedLoop loop(name, name);
    const auto gain = analysis::DesignObserver(loop.rig.plant, {});
    EXPECT_EQ(gain.force_n_per_m.cols(), 1) << name;
    EXPECT_GT(gain.settling_s, 0.0) << name;
    EXPECT_LT(gain.settling_s, 5.0) << name;
  }
}

TEST(OneAxis, FallsWithKpBelowTheNegativeStiffness) {
  ShippedLoop loop = OneAxis();
  loop.controller.law.axes[0].kp_a_per_m = 900.0;  // ki Kp = 3.6e4 < ks = 4e4 N/m
  loop.controller.law.axes[0].ki_a_per_m_s = 0.0;
  EXPECT_NE(loop.Play(20261121, 20.0), "");
}

// m x'' = ks x: an exponential with rate sqrt(ks/m), as long as the amplifier has nothing to do.
TEST(OneAxis, LeavesTheCentreWithTheRateOfItsNegativeStiffness) {
  const ShippedLoop loop = OneAxis();
  const auto model = plant::Linearise(loop.rig.plant, 0.0);
  double fastest = 0.0;
  for (const auto& pole : Eigen::MatrixXd(model.a).eigenvalues()) {
    fastest = std::max(fastest, pole.real());
  }
  const double ks_n_per_m = 40.0 * 1.0 / 1e-3;  // ki i0/s0
  EXPECT_NEAR(fastest, std::sqrt(ks_n_per_m / 0.5), 1e-9);
}

// Without the integrator it hangs below the centre: (ki Kp - ks) x = m g for the linear magnet.
TEST(OneAxis, HangsBelowTheCentreWithoutIntegrator) {
  ShippedLoop loop = OneAxis();
  loop.controller.law.axes[0].ki_a_per_m_s = 0.0;
  loop.controller.supervisor.sequence.settle_radius_m = 300e-6;
  double sum_m = 0.0;
  double count = 0.0;
  loop.scenario.steps.resize(1);
  (void)loop.Play(20261121, 5.0, [&](const cycle::CycleRecord& record) {
    sum_m += record.in.frame.position_m[0];
    count += 1.0;
  });
  const double droop_m = 0.5 * 9.81 / (40.0 * 1780.0 - 40'000.0);  // 157 um
  // The true magnet is steeper than its tangent: at 157 um of 1 mm by (x/s0)^2 = 2.5 %, of which
  // the difference of two stiffnesses makes several times as much.
  EXPECT_NEAR(sum_m / count, -droop_m, 0.15 * droop_m);
}

TEST(OneAxis, SidewaysItIsHeldAndStill) {
  const ShippedLoop loop = OneAxis();
  plant::Plant plant(loop.rig.plant, 1);
  plant.PlaceAtRest({50e-6, 50e-6});
  for (int n = 0; n < 1000; ++n) plant.Advance({.bias_current_a = 1.0});
  EXPECT_NEAR(plant.ActuatorPosition()[1], 0.0, 1e-12);  // 0.1 s: 100 periods of the guide
  EXPECT_GT(std::abs(plant.ActuatorPosition()[0]), 100e-6);
}

TEST(OneAxis, HasPolesAndASensitivityLikeAnyOtherRig) {
  const ShippedLoop loop = OneAxis();
  EXPECT_TRUE(analysis::ClosedLoopPoles(loop.rig.plant, loop.controller.law, 0.0).stable);
  const auto peaks = analysis::SensitivityPeaks(loop.rig.plant, loop.controller.law, 0.0);
  ASSERT_EQ(peaks.axes.size(), 1U);
  EXPECT_LT(peaks.axes[0].peak, 3.0);  // zone A
}

}  // namespace
}  // namespace levitas::test

// The sensitivity that a campaign on the noisy nonlinear plant measures is the one computed about
// the point at which the loaded rotor stands.

#include "identification/frf/measured_sensitivity.hpp"

#include <gtest/gtest.h>

#include <cstddef>

#include "benchmark/accuracy/identification/simulated_campaign.hpp"
#include "tests/loop/identification/flexible_rotor.hpp"

namespace levitas::identification {
namespace {

class LoadedCampaign : public testing::TestWithParam<double> {};

TEST_P(LoadedCampaign, MeasuresThePeaksThatWereComputed) {
  configuration::RigFile rig = FlexibleRotor();
  rig.plant.gravity_m_per_s2 = GetParam();
  const auto controller = configuration::LoadController(
      configuration::FindConfig("flexible_rotor_commissioned", "controllers"), rig.numbers);
  const auto computed = analysis::SensitivityPeaks(rig.plant, controller.law, 0.0);
  accuracy::ExcitationPlan plan;
  plan.amplitude_a = 0.15;  // as the shipped campaign
  plan.periods = 8;
  const auto responses = EstimateResponses(accuracy::SimulateCampaign(rig, plan), 1e-4);
  ASSERT_EQ(responses.size(), 1U);
  const auto measured = MeasuredPeaks(responses.front());
  ASSERT_EQ(measured.size(), computed.axes.size());
  for (std::size_t axis = 0; axis < measured.size(); ++axis) {
    EXPECT_EQ(measured[axis].refused, "") << axis;
    // 5 % for the magnets' nonlinearity, and three sigma of the line.
    EXPECT_NEAR(measured[axis].peak, computed.axes[axis].peak,
                0.05 * computed.axes[axis].peak + 3.0 * measured[axis].sigma)
        << axis;
    EXPECT_LT(measured[axis].sigma, 0.1 * measured[axis].peak);
  }
}

INSTANTIATE_TEST_SUITE_P(Gravity, LoadedCampaign, testing::Values(0.0, 9.81, 17.0));

}  // namespace
}  // namespace levitas::identification

// The published cost in decibels: which lines get which weight, and what a residual is.
#include "identification/modal/decibel_fit.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "configuration/rig_file.hpp"
#include "identification/modal/line_residuals.hpp"
#include "identification/modal/modal_response.hpp"
#include "tests/support/paths.hpp"

namespace levitas::identification {
namespace {

constexpr double kTurnsHz = 50.0;

const ModalStart& DecibelStart() {
  static const ModalStart start = StartFromRig(
      configuration::LoadRig(test::SourceFolder() + "/config/rigs/flexible_rotor.yaml").plant, 4);
  return start;
}

/// The rig's own response on every hertz, with a relative deviation of `noise`.
FrequencyResponse OwnResponse(double speed_rad_per_s, double noise) {
  const Physical rig = ToPhysical(DecibelStart().frame, DecibelStart().vector);
  FrequencyResponse data;
  data.speed_rad_per_s = speed_rad_per_s;
  data.period_s = 1e-4;
  data.channels = {"de_x", "de_y", "nde_x", "nde_y"};
  for (double f = 1.0; f < 1200.0; f += 1.0) {
    data.frequency_hz.push_back(f);
    data.plant.push_back(ModalResponse(DecibelStart().frame, rig, f, speed_rad_per_s));
    data.currents.emplace_back(Eigen::MatrixXcd::Identity(4, 4));
    data.variance.emplace_back(noise * noise * data.plant.back().cwiseAbs2());
  }
  return data;
}

std::vector<Eigen::MatrixXd> WeightsOf(const FrequencyResponse& data) {
  const ModalStart& start = DecibelStart();
  return DecibelWeights(start.frame, ToPhysical(start.frame, start.vector), data,
                        {.lowest_hz = 10.0, .highest_hz = 1000.0});
}

TEST(DecibelWeights, AreThirtyWithinFiveHertzOfAPeakAndOneElsewhere) {
  const FrequencyResponse data = OwnResponse(0.0, 0.01);
  const auto weights = WeightsOf(data);
  const auto at = [&](double hz) { return weights[static_cast<std::size_t>(hz) - 1](0, 0); };
  // The largest reading near the second bending mode of the paper's rotor, 252 Hz, is a peak.
  std::size_t peak = 239;
  for (std::size_t k = 239; k < 264; ++k) {
    if (std::abs(data.plant[k](0, 0)) > std::abs(data.plant[peak](0, 0))) peak = k;
  }
  const double peak_hz = data.frequency_hz[peak];
  for (const double off : {-5.0, 0.0, 5.0}) EXPECT_EQ(at(peak_hz + off), 30.0) << off;
  EXPECT_EQ(at(30.0), 1.0);  // below every mode the response falls without a turn
  EXPECT_EQ(at(9.0) + at(1001.0), 0.0) << "outside the band";
  for (const Eigen::MatrixXd& line : weights) {
    for (Eigen::Index i = 0; i < 4; ++i) EXPECT_EQ(line(i, (i + 1) % 4), 0.0) << "across planes";
  }
}

TEST(DecibelWeights, AreATenthWhereNoiseRulesEvenOnAPeak) {
  FrequencyResponse data = OwnResponse(0.0, 0.01);
  const auto clean = WeightsOf(data);
  for (Eigen::MatrixXd& variance : data.variance) variance *= 100.0 * 100.0;  // the reading itself
  const auto noisy = WeightsOf(data);
  std::size_t marked = 0;
  for (std::size_t k = 0; k < clean.size(); ++k) {
    for (Eigen::Index e = 0; e < 16; ++e) {
      const double was = clean[k].data()[e];
      marked += was == 30.0 ? 1 : 0;
      EXPECT_EQ(noisy[k].data()[e], was == 0.0 ? 0.0 : 0.1);
    }
  }
  EXPECT_GT(marked, 100U);
}

TEST(DecibelWeights, LeaveOutWhatIsBelowOnePerTurn) {
  const auto weights = WeightsOf(OwnResponse(2.0 * std::numbers::pi * kTurnsHz, 0.01));
  EXPECT_EQ(weights[48].maxCoeff(), 0.0);  // 49 Hz
  EXPECT_GT(weights[50](0, 0), 0.0);       // 51 Hz
}

TEST(DecibelResiduals, AreTheDistanceInDecibelsTimesTheWeight) {
  FrequencyResponse data = OwnResponse(0.0, 0.01);
  const std::size_t line = 99;
  Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(4, 4);
  weights(2, 0) = 30.0;
  weights(1, 3) = 0.1;
  // 20 dB below the model, its sign a phase, of which nothing is asked; and 20 dB above it.
  data.plant[line](2, 0) *= -0.1;
  data.plant[line](1, 3) *= 10.0;
  const WorkingGains gains;
  const LineResiduals residuals(DecibelStart().frame, data, gains, line, weights);
  ASSERT_EQ(residuals.rows(), 2);
  std::array<double, 2> left{};
  residuals.Evaluate(ToPhysical(DecibelStart().frame, DecibelStart().vector), left);
  EXPECT_NEAR(left[0], 600.0, 1e-9);
  EXPECT_NEAR(left[1], -2.0, 1e-9);
}

}  // namespace
}  // namespace levitas::identification

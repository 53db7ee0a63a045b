// The search's own reading of a loop against analysis, which shares no line with it.
#include "design/pid/loop_survey.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/poles.hpp"
#include "analysis/sensitivity.hpp"
#include "common/random.hpp"
#include "design/pid/law_shape.hpp"
#include "tests/loop/design/survey_against_analysis.hpp"

namespace levitas::design {
namespace {

configuration::RigFile ShippedRig(const std::string& name) {
  return configuration::LoadRig(configuration::FindConfig(name, "rigs"));
}

std::vector<law::DiscreteLaw> AsTheyRun(const law::LawConfig& law) {
  std::vector<law::DiscreteLaw> out;
  for (const auto& axis : law.axes) out.push_back(law::Discretise(axis, law.period_s));
  return out;
}

/// Gains and filters drawn widely around what levitates: about half of the loops are unstable.
law::LawConfig Drawn(const configuration::RigFile& rig, const SampledPlant& plant, Random& draw) {
  LawShape shape;
  shape.bearings = rig.plant.bearings.size();
  shape.axes = rig.numbers.axes();
  shape.period_s = rig.numbers.period_s();
  shape.current_limit_a = 1.0;
  PlainGains gains;
  gains.notch_hz = {400.0, 900.0};
  for (std::size_t b = 0; b < shape.bearings; ++b) {
    const std::size_t axis = std::min(2 * b, shape.axes - 1);
    const double even = plant.displacement_n_per_m()[axis] / plant.current_n_per_a()[axis];
    gains.kp_a_per_m.push_back(even * (1.0 + std::exp(draw.Normal() - 0.5)));
    gains.kd_a_s_per_m.push_back(gains.kp_a_per_m.back() * 2e-3 * std::exp(draw.Normal()));
  }
  Eigen::VectorXd x = StartAt(shape, gains);
  for (Eigen::Index i = static_cast<Eigen::Index>(2 * shape.bearings) + 1; i < x.size(); ++i)
    x(i) += 0.3 * draw.Normal();
  return LawAt(shape, x);
}

double LeastDamping(const configuration::RigFile& rig, const law::LawConfig& law, double speed) {
  double least = 1.0;
  for (const auto& pole : analysis::ClosedLoopPoles(rig.plant, law, speed).poles) {
    const double hz = std::abs(pole.frequency_hz);
    if (hz > 1.0 && hz < 0.49 / law.period_s) least = std::min(least, pole.damping_ratio);
  }
  return least;
}

class SurveyOfARig : public ::testing::TestWithParam<const char*> {};

TEST_P(SurveyOfARig, AgreesWithEigenvaluesAndBracketedPeaks) {
  const auto rig = ShippedRig(GetParam());
  Random draw(3);
  int stable = 0;
  for (const double share : {0.0, 1.0}) {
    const double speed = share * rig.numbers.max_speed_rad_per_s;
    const SampledPlant plant(rig, speed);
    for (int n = 0; n < 12; ++n) {
      const auto law = Drawn(rig, plant, draw);
      const auto survey = Survey(plant, AsTheyRun(law), std::vector<double>(8, 1e-6));
      const auto exact = analysis::SensitivityPeaks(rig.plant, law, speed);
      const std::string which = std::to_string(share) + " draw " + std::to_string(n);
      if (!ExpectAsAnalysisSays(survey, exact, which)) continue;
      ++stable;
      const double least = LeastDamping(rig, law, speed);
      // 1e-3: poles on the axis are taken as damped by 0.002 %, Newton stops at 2e-4 of the pole.
      if (least < 0.1) {
        EXPECT_NEAR(survey.damping.value, least, 1e-3) << which;
      }
    }
  }
  EXPECT_GT(stable, 5);
}

INSTANTIATE_TEST_SUITE_P(Shipped, SurveyOfARig,
                         ::testing::Values("flexible_rotor", "turbomolecular_pump",
                                           "geared_rotor_4dof", "one_axis"));

/// A disc in the middle of a plain shaft between like bearings: its shift is the same in x and y at
/// every speed, and so are two pairs of poles.
configuration::RigFile SameInTwoDirections() {
  auto rig = ShippedRig("flexible_rotor");
  rotor::RotorConfig& rotor = rig.plant.rotor;
  rotor.sections = {{0.3, 0.066, 0.0}};
  rotor.discs = {{0.15, 20.0, 0.15, 0.3}};
  rotor.modes_per_plane = 2;
  rig.plant.unbalance.clear();
  rig.plant.effects.clear();
  rig.plant.bearings[1] = rig.plant.bearings[0];
  for (const std::size_t b : {0U, 1U}) {
    rig.plant.bearings[b].actuator_z_m = b == 0 ? 0.06 : 0.24;
    rig.plant.bearings[b].sensor_z_m = b == 0 ? 0.04 : 0.26;
  }
  return rig;
}

TEST(SampledPlantOfASymmetricRotor, HasIndependentModesAtEverySpeed) {
  const auto rig = SameInTwoDirections();
  for (const double share : {0.0, 0.1, 0.37, 0.5, 1.0}) {
    const double speed = share * rig.numbers.max_speed_rad_per_s;
    EXPECT_NO_THROW(SampledPlant(rig, speed)) << share;
  }
}

// One mass on one magnet: P(s) = ki A/(m s^2 - ks), known in closed form but for the hold.
TEST(SampledPlantOfOneAxis, IsTheMassOnItsNegativeSpring) {
  const SampledPlant plant(ShippedRig("one_axis"), 0.0);
  EXPECT_EQ(plant.growing(), 1);
  constexpr double kHz = 5.0;  // amplifier 1 kHz, sensor 5 kHz, delay 0.15 ms: below 1 % in size
  const double w = 2.0 * M_PI * kHz;
  // The weight moves ks by (ic0/i0)^2 = 1.5 %.
  EXPECT_NEAR(std::abs(plant.AtHz(kHz).plant(0, 0)), 40.0 / (0.5 * w * w + 4e4), 0.03 * 40.0 / 4e4);
}

// Noise through C S: white noise of variance v leaves v times the mean of |C S|^2.
TEST(SurveyOfNoise, DoublesWithTheNoiseAndVanishesWithoutIt) {
  const auto rig = ShippedRig("flexible_rotor");
  const SampledPlant plant(rig, 0.0);
  const auto laws =
      AsTheyRun(configuration::LoadController(
                    configuration::FindConfig("flexible_rotor", "controllers"), rig.numbers)
                    .law);
  const auto one = Survey(plant, laws, std::vector<double>(4, 1e-6));
  const auto two = Survey(plant, laws, std::vector<double>(4, 2e-6));
  const auto none = Survey(plant, laws, std::vector<double>(4, 0.0));
  EXPECT_NEAR(two.current_a[0], 2.0 * one.current_a[0], 1e-9 * one.current_a[0]);
  EXPECT_EQ(none.current_a[0], 0.0);
}

}  // namespace
}  // namespace levitas::design

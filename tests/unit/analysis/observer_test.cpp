#include "analysis/records/observer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "analysis/reading_noise.hpp"
#include "common/problem.hpp"
#include "common/random.hpp"
#include "plant_sim/plant/plant_model.hpp"
#include "tests/support/effect_entry.hpp"
#include "tests/support/test_rigs.hpp"
#include "tests/unit/analysis/laws.hpp"

namespace levitas::analysis {
namespace {

std::shared_ptr<const ObserverGain> GainFor(const plant::PlantConfig& plant) {
  return std::make_shared<const ObserverGain>(DesignObserver(plant, {}));
}

TEST(ReadingNoise, AddsTheConvertersStepToTheNoise) {
  plant::SensorConfig sensor;
  sensor.noise_rms_m = 3e-6;
  EXPECT_DOUBLE_EQ(ReadingNoise(sensor), 3e-6);
  sensor.adc_bits = 3;
  sensor.range_m = 4e-6 * 4.0 * std::sqrt(12.0);  // step 4 um sqrt(12): 4 um rms
  EXPECT_NEAR(ReadingNoise(sensor), 5e-6, 1e-18);
}

TEST(DesignObserver, SettlesWithinATenthOfASecondAndExpectsLittleMoreThanTheNoise) {
  const auto gain = GainFor(test::FlexibleRotor());
  EXPECT_GT(gain->settling_s, 0.0);
  EXPECT_LT(gain->settling_s, 1.0);
  for (std::size_t axis = 0; axis < 4; ++axis) {
    const double ratio = gain->expected_innovation_m[axis] / gain->sensor_noise_m[axis];
    EXPECT_GT(ratio, 1.0);  // a prediction never adds information about the next reading's noise
    EXPECT_LT(ratio, 1.5);
  }
}

TEST(DesignObserver, TrustsTheSensorsMoreWhenMoreForceIsUnknown) {
  const auto plant = test::FlexibleRotor();
  ObserverTuning little;
  little.force_noise_share = 0.001;
  ObserverTuning much;
  much.force_noise_share = 0.1;
  EXPECT_GT(DesignObserver(plant, much).state.norm(), DesignObserver(plant, little).state.norm());
}

// A newton on the rotor is one newton, whatever the magnet's current has to pass first. Taken from
// the coil's own column it was a twentieth of that behind eddy currents, and the observer,
// which hardly believed in forces, took seconds to find the rotor.
TEST(DesignObserver, KnowsForcesThatDoNotComeFromTheCoil) {
  plant::PlantConfig lagging = test::FlexibleRotor();
  lagging.effects.push_back(test::Entry(effect::Id::kEddyCurrent, {50e-6, 1.0}));
  const auto plain = GainFor(test::FlexibleRotor());
  const auto behind = GainFor(lagging);
  const Eigen::Index rotor = 4 * 8;  // q and v of eight modes in both planes
  const Eigen::MatrixXd of_rotor = plain->force_step.topRows(rotor);
  EXPECT_LT((behind->force_step.topRows(rotor) - of_rotor).norm(), 0.01 * of_rotor.norm());
  const Eigen::MatrixXd corrected = plain->state.topRows(rotor);
  EXPECT_LT((behind->state.topRows(rotor) - corrected).norm(), 0.05 * corrected.norm());
}

TEST(DesignObserver, RefusesSensorsWithoutAnyNoise) {
  EXPECT_THROW(static_cast<void>(DesignObserver(test::QuietFlexibleRotor(), {})), Problem);
}

// A rotor held by currents that carry exactly its weight, at the centre where the magnet pulls
// ki ic in good measure: the observer must find the force it was not told of.
TEST(DesignSettling, BeginsWithWhatTheFastObserverKnewAndEndsWithTheStationaryGain) {
  const auto plant = test::FlexibleRotor();
  const ObserverTuning fast;
  const ObserverTuning slow{0.0, 0.001, 1e-6};
  const std::vector<StagedGain> stages = DesignSettling(plant, fast, slow);
  const ObserverGain last = DesignObserver(plant, slow);
  ASSERT_GT(stages.size(), 3U);
  EXPECT_EQ(stages.front().from_sample, 0U);
  EXPECT_EQ(stages.back().gain.state, last.state);
  EXPECT_EQ(stages.back().gain.force_n_per_m, last.force_n_per_m);
  for (std::size_t i = 1; i < stages.size(); ++i) {
    EXPECT_GT(stages[i].from_sample, stages[i - 1].from_sample);
  }
  // The slower observer is to know more than the fast one did.
  EXPECT_GT(stages.front().gain.expected_innovation_m[0], last.expected_innovation_m[0]);
  EXPECT_GT(stages.front().gain.state.norm(), last.state.norm());
  // A force that is known to be zero is learnt from nothing that happens in a few samples.
  EXPECT_LT(stages.front().gain.force_n_per_m.norm(), 0.05 * last.force_n_per_m.norm());
}

TEST(Observer, FindsAConstantForceTheRigFileDoesNotHave) {
  plant::PlantConfig truth = test::FlexibleRotor();
  truth.gravity_m_per_s2 = 0.0;
  const auto gain = GainFor(truth);
  Observer observer(truth, gain);
  observer.Restart({});
  RecordedSample sample;
  sample.command.bias_current_a = 1.0;
  sample.command.control_current_a = {0.1, 0.1, -0.05, -0.05};  // the sensors see no motion
  for (int n = 0; n < 20'000; ++n) observer.Step(sample);
  for (std::size_t axis = 0; axis < 4; ++axis) {
    const double magnet_n = 40.0 * sample.command.control_current_a[axis];
    // The sensors say: no motion. So some force holds the magnets' in balance; 2 % for the rotor
    // bending under forces that are not where the sensors are.
    EXPECT_NEAR(observer.unknown_force_n()[static_cast<Eigen::Index>(axis)], -magnet_n,
                0.05 * std::abs(magnet_n));
  }
}

TEST(Observer, HasNoInnovationAgainstItself) {
  plant::PlantConfig config = test::FlexibleRotor();
  config.gravity_m_per_s2 = 0.0;
  config.unbalance.clear();
  Observer observer(config, GainFor(config));
  observer.Restart({});
  RecordedSample sample;
  sample.command.bias_current_a = 1.0;
  for (int n = 0; n < 100; ++n) {
    const AxisArray innovation_m = observer.Step(sample);
    for (const double value : innovation_m) EXPECT_EQ(value, 0.0);
  }
}

TEST(Observer, RestartsAtTheMeasuredPlace) {
  const plant::PlantConfig config = test::FlexibleRotor();
  Observer observer(config, GainFor(config));
  const AxisArray place_m{20e-6, -10e-6, 5e-6, 30e-6};
  observer.Restart(place_m);
  const AxisArray seen_m = observer.plant().SensorOutput();
  for (std::size_t axis = 0; axis < 4; ++axis) EXPECT_NEAR(seen_m[axis], place_m[axis], 1e-12);
}

TEST(Observer, OfARigWithReversedProbesAndCoilsIsDrivenInTheBearingFrame) {
  plant::PlantConfig config = test::FlexibleRotor();
  config.sensor_polarity[1] = -1.0;
  config.actuator_polarity[0] = -1.0;
  Observer straight(test::FlexibleRotor(), GainFor(test::FlexibleRotor()));
  Observer reversed(config, GainFor(config));
  RecordedSample sample;
  sample.command.bias_current_a = 1.0;
  sample.command.control_current_a = {0.1, -0.2, 0.1, 0.05};
  sample.position_m = {1e-6, 2e-6, -3e-6, 4e-6};
  straight.Restart(sample.position_m);
  reversed.Restart(sample.position_m);
  for (int n = 0; n < 50; ++n) EXPECT_EQ(straight.Step(sample), reversed.Step(sample));
}

TEST(Observer, RefusesAModelThatStillHasTheWiring) {
  plant::PlantConfig config = test::FlexibleRotor();
  config.actuator_polarity[2] = -1.0;
  const auto wired = std::make_shared<const plant::PlantModel>(config);
  EXPECT_THROW(Observer(wired, GainFor(config)), std::invalid_argument);
}

}  // namespace
}  // namespace levitas::analysis
